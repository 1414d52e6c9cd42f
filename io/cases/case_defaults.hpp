// Defaults that a case takes: everybody's, or those of its test, law, recipe or dimension.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "io/cases/keys_layer.hpp"
#include "io/cases/keys_schema.hpp"

namespace breccia {

/// A default and whose it is.
struct Standard {
  std::string_view value;
  std::string_view of;  ///< "time.accuracy", "material.law", ...; empty: everybody's
};

/// What decides which defaults a case takes.
struct Standards {
  std::string_view program;
  Space space = Space::three_d;
  std::string_view law, accuracy;
  bool rolls = false;  ///< the material resists rolling

  Standard of(const Key& key) const;
};

bool is_material(std::string_view key);

/// Whether a key that was not given takes its default in this case.
bool takes_standard(const Key& key, const Layer& layer, std::string_view program);

/// Defaults that a reader of everybody's would not expect, one a line.
/// @param layer, material  keys of the case, and of its material
std::vector<std::string> unusual_defaults(const Layer& layer, const Layer& material,
                                          const Standards& defaults);

}  // namespace breccia
