// A case is laid in layers: preset, case file, --set; what a higher layer gives hides what lies
// below.
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/cases/keys_value.hpp"

namespace breccia {

struct Given {
  Reading reading;
  std::string place;  ///< "file:line", "--set"; empty: a default
};

/// Values by the full names of their keys.
using Layer = std::map<std::string, Given, std::less<>>;

/// Keys of the material for one confinement: a [[material.at]] of a case, an [[at]] of a preset.
struct ConfinementLayer {
  double confinement = 0;  ///< Pa
  Layer layer;
  std::string place;
};

/// Keys of the material of one cohesive group: a [[material.group]] of a case.
struct GroupLayer {
  int group = 0;
  Layer layer;
  std::string place;
};

/// What one file, or all --set together, give.
struct Source {
  std::filesystem::path file;  ///< of a preset
  Layer layer;
  std::optional<std::vector<ConfinementLayer>> at;  ///< nothing: no [[material.at]] written
  std::vector<GroupLayer> groups;
  std::vector<std::string> tables;  ///< tables that a --set replaces wholly
};

/// Reads and checks every key of a case file.
/// @throws BadInput: unknown key, a key the test does not accept, a wrong value
Source read_case_source(const TomlNode& root, const std::string& test);

/// Reads "table.key=value" texts; later ones win.
Source read_set_source(const std::vector<std::string>& sets, const std::string& test);

/// A material preset: keys of the material at top level, [[at]] tables, `source` in words.
Source read_preset_source(const TomlNode& root);

/// Removes every key whose name begins so.
void erase_below(Layer&, std::string_view prefix);

/// Lays `high` over `low`. A key that excludes another (fracture energy and damage, file and pack)
/// hides that too.
void lay_over(Layer& low, const Layer& high);

/// Equal within one part in a million.
bool same_confinement(double a, double b);

/// The layer for a confinement, or nullptr.
const Layer* find_confinement(const std::vector<ConfinementLayer>&, double confinement);

}  // namespace breccia
