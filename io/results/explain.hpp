// What a scene uses and what it leaves out, in words and bytes: `--explain`.
#pragma once
#include <string>

#include "core/world/world.hpp"

namespace breccia {

std::string explain(const World& world);

}  // namespace breccia
