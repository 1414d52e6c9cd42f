#include "io/text/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace breccia {

std::string format_columns(const std::vector<TextColumn>& columns) {
  std::vector<std::string> lines(columns.empty() ? 0 : columns.front().cells.size() + 2);
  for (const TextColumn& column : columns) {
    const auto& rows = column.cells;
    if (std::all_of(rows.begin(), rows.end(), [](const std::string& cell) { return cell.empty(); })) continue;
    std::vector<std::string> cells{column.name, column.unit};
    for (const std::string& cell : rows) cells.push_back(cell.empty() ? "-" : cell);
    std::size_t width = 0;
    for (const std::string& cell : cells) width = std::max(width, cell.size());
    for (std::size_t k = 0; k < cells.size(); ++k) lines[k] += fmt::format("  {:>{}}", cells[k], width);
  }
  std::string text;
  for (const std::string& line : lines) text += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
  return text;
}

std::string four_digits(double value) {
  const int before = value >= 1.0 ? static_cast<int>(std::floor(std::log10(value))) + 1 : 0;
  return fmt::format("{:.{}f}", value, std::max(0, 4 - before));
}

}  // namespace breccia
