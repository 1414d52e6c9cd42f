#include "drivers/studies/study_json.hpp"

#include <fmt/format.h>

#include <iterator>

namespace breccia {

nlohmann::ordered_json json_of(const Machine& m) {
  nlohmann::ordered_json caches = nlohmann::ordered_json::array();
  for (const Cache& c : m.caches)
    caches.push_back({{"level", c.level}, {"type", c.type}, {"bytes", c.bytes}, {"shared_by", c.shared_by}});
  return {{"cpu", m.cpu},
          {"cores", m.cores},
          {"cores_online", m.cores_online},
          {"caches", caches},
          {"memory_bytes", m.memory_bytes},
          {"load_average", m.load_average},
          {"compiler", m.compiler},
          {"instruction_set", m.instruction_set}};
}

namespace {

/// A field of a line: text with a comma or a quote in it is quoted (RFC 4180), what is not there is
/// empty.
std::string field(const nlohmann::ordered_json& value) {
  if (value.is_null()) return {};
  if (!value.is_string()) return value.dump();
  const std::string text = value.get<std::string>();
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace

std::string csv_of(const std::vector<nlohmann::ordered_json>& rows) {
  std::string text;
  for (const auto& row : rows) {
    std::string names, line;
    for (const auto& [name, value] : row.items()) {
      const std::string_view comma = line.empty() ? "" : ",";
      fmt::format_to(std::back_inserter(names), "{}{}", comma, name);
      fmt::format_to(std::back_inserter(line), "{}{}", comma, field(value));
    }
    if (text.empty()) text = names + '\n';
    text += line + '\n';
  }
  return text;
}

}  // namespace breccia
