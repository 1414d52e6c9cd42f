// Materials of a case: presets found and read, layers laid for each confinement.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "io/cases/keys_layer.hpp"
#include "kernels/laws/bond_law.hpp"

namespace breccia {

/// Layers of the material as they stand for one case, lowest first.
struct MaterialLayers {
  Layer preset;
  std::vector<ConfinementLayer> preset_at;
  Layer given;  ///< the case's [material]
  std::vector<ConfinementLayer> given_at;
  Layer set;  ///< --set
};

/// The folder data/ of the source tree, with materials/ that come with breccia.
std::filesystem::path shipped_data();

/// Reads the preset called `name` from materials/ beside the case, beside its folder, in
/// $BRECCIA_DATA, in the source tree.
/// @param place  where the name was given
/// @throws BadInput: unknown name, with those present; or what is wrong in the preset's file
Source read_preset(const std::string& name, const std::string& place,
                   const std::filesystem::path& case_folder);

/// The whole material, laid from the preset, what stands for one confinement in it, [material],
/// [[material.at]] and --set, each over the one before.
/// @param preset_at, given_at  nullptr: nothing stands there
Layer laid(const MaterialLayers&, const Layer* preset_at, const Layer* given_at);

/// The keys in force where no confinement is named; a confinement changes some of them.
Layer material_base(const MaterialLayers&);

/// What the header of a law says of it.
struct LawFacts {
  std::string_view name;
  std::vector<std::string> takes;
  std::vector<LawParameter> own;
  std::vector<LawDefault> defaults;
  bool plasticity = false;
  bool cement = false;  ///< intact bonds pass moments

  bool has(std::string_view key) const;  ///< uses this key of [material], one that not every law uses
};
const LawFacts& facts_of(std::string_view law);

/// The law that a material's keys ask for.
std::string law_of(const Layer& material);

/// The keys of a group's material, its preset's beneath them; those of other laws, and those that
/// belong to the whole material, leave.
/// @param law  of the scene
/// @param inputs  the preset's file is added here
Layer layer_of_group(const GroupLayer& group, const std::string& law,
                     const std::filesystem::path& case_folder, std::vector<std::filesystem::path>& inputs);

/// A key in the case for something that its law lacks is refused by name; presets may hold more
/// than a law uses.
void refuse_foreign_keys(const Layer& given, const std::string& law);

/// Checks that nothing is missing for the features in use and fills a Material.
/// @param file  named where a key is missing
Material make_material(const Layer&, const FeatureCase&, Elasticity, const std::string& file);

}  // namespace breccia
