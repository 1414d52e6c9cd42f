// The resolved case and the printed reference of keys.
#pragma once
#include <string>
#include <vector>

#include "io/cases/keys_layer.hpp"

namespace breccia {

/// A case as TOML with every default written out; reads back to the same case.
/// @param keys  all keys but those of the material
/// @param base  the material where no confinement is named
/// @param at    the material for each confinement; only what differs from `base` is written, behind
///              `place`, if any, as a comment
/// @param groups  materials of cohesive groups: what each has otherwise
std::string write_case(const Layer& keys, const Layer& base, const std::vector<ConfinementLayer>& at,
                       const std::vector<GroupLayer>& groups, const std::string& test);

/// What is valid behind a key, for the printed reference: "a length, more than 0 m".
std::string describe_values(const Key& key);

}  // namespace breccia
