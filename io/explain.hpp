// What a scene uses and what it leaves out, in words and bytes: `--explain`.
#pragma once
#include <string>

#include "core/world.hpp"

namespace breccia {

/// @param asked  what the scene asks for; the world holds what is built
std::string explain(const World& world, const Features& asked);

}  // namespace breccia
