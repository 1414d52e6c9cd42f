// What the files of all studies have in common.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "drivers/programs/machine.hpp"

namespace breccia {

nlohmann::ordered_json json_of(const Machine& machine);

/// A line of names and one for each row, comma separated.
/// @param rows  objects with the same names, in the same order
std::string csv_of(const std::vector<nlohmann::ordered_json>& rows);

}  // namespace breccia
