// The machine of a measurement, for files.
#pragma once
#include <nlohmann/json.hpp>

#include "io/machine.hpp"

namespace breccia {

nlohmann::ordered_json json_of(const Machine& machine);

}  // namespace breccia
