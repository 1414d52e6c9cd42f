// The keys of an impact case, one declaration each: reading, checks, the resolved case and --help
// derive from it.
#pragma once
#include <span>
#include <string>
#include <string_view>

#include "core/impact/impact.hpp"
#include "io/cases/keys_schema.hpp"

namespace breccia {

/// One key of a table that fills a `T`. Its name is "table.word".
template <class T>
struct Field {
  Key key;
  void (*store)(T&, const Reading&) = nullptr;
  bool required = false;
  std::string_view kinds{};  ///< walls: the kinds that have this key; empty: all
};

/// A particle or wall as it stands in the case: its material by name.
struct ParticleEntry {
  ImpactParticle particle;
  std::string material;
};
struct WallEntry {
  ImpactWall wall;
  std::string kind, material, name;
};
/// [spheres]: many particles at once, from a file.
struct SpheresEntry {
  std::string file, material;
  Vec3 velocity, spin;  ///< m/s, rad/s
};

std::span<const Field<ImpactMaterial>> material_fields();  ///< [materials.NAME]
std::span<const Field<ParticleEntry>> particle_fields();   ///< [[particle]]
std::span<const Field<WallEntry>> wall_fields();           ///< [[wall]]
std::span<const Field<SpheresEntry>> spheres_fields();     ///< [spheres]
std::span<const Field<ImpactScene>> scene_fields();        ///< [contact], [scene], [time], [output]

}  // namespace breccia
