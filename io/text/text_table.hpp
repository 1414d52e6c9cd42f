// Tables for the terminal.
#pragma once
#include <string>
#include <vector>

namespace breccia {

struct TextColumn {
  std::string name, unit;
  std::vector<std::string> cells;  ///< one for each row; empty where the row has no value
};

/// Names, units and rows, columns to the right of each other; a cell without a value is a dash, a
/// column without any is left out. Lines end with '\n'.
/// @param columns  all of the same number of cells
std::string format_columns(const std::vector<TextColumn>& columns);

/// Four digits, of a number below 1 four decimals, never an exponent: "0.4321", "43.21", "4321".
std::string four_digits(double value);

}  // namespace breccia
