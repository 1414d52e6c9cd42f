// A case file, resolved: every key with its unit taken off and its default filled in.
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/base/scene_options.hpp"
#include "core/geometry/specimen.hpp"
#include "core/packing/packing.hpp"
#include "kernels/laws/material.hpp"

namespace breccia {

struct SpecimenCase {
  std::optional<std::filesystem::path> file;  ///< the case's folder in front
  std::string sha256;                         ///< of the file, 64 hex digits
  std::optional<PackRequest> pack;
  Space space = Space::three_d;
  Body body;                   ///< a disc in the plane: its height is its diameter
  char axis = 'z';             ///< of the cylinder or disc in the file; in the plane the direction of loading
  std::optional<Vec3> centre;  ///< m; overrides the middle of the box around the spheres
};

struct BondsCase {
  double range = 0.10;                 ///< beta
  std::optional<double> coordination;  ///< target instead of range
  AlphaRule alpha_rule = AlphaRule::automatic;
  double alpha = 0;  ///< when alpha_rule is number
  Elasticity elasticity = Elasticity::paper;
  AreaRule area = AreaRule::minimum;
  std::optional<AreaRule> strength_area;  ///< nothing: alpha times the area
  bool between_groups = false;
};

/// Spheres of a cohesive group that have a material of their own.
struct GroupCase {
  int group = 0;
  std::vector<Material> materials;  ///< one per confinement, in the order of test.confinement
  std::string place;                ///< "file:line"
};

struct DampingCase {
  double contact = 0.9;     ///< xi, fraction of critical, along the bond
  bool paper_form = false;  ///< form = "paper": times pi alpha r_c/d0
  DampingScheme scheme = DampingScheme::explicit_;
  double translation = 0.1, rotation = 0.1;
  std::optional<double> viscous_rate;  ///< 1/s, instead of both
};

struct TestCase {
  std::vector<double> confinement{0.0};  ///< Pa
  bool rough_platens = true;
  std::vector<double> intermediate_stress;  ///< Pa, none, one, or one for each confinement
  HydrostaticResponse hydrostatic_branch = HydrostaticResponse::elastic;
  double platen_speed = 0.1;  ///< m/s, of each platen
  double stop_strain = 0.02;
  double stop_after_peak = 0.5;   ///< fraction of the peak deviator; 0 = never
  std::vector<double> unload_at;  ///< platen strains
  double unload_to = 0.1;
  std::optional<char> load_axis;  ///< bts: in the file
  SkinWeights skin_weights = SkinWeights::radius;
  bool current_surface = false;       ///< pressure acts on the lateral surface as it is
  bool plane_strips = false;          ///< bts
  std::optional<double> strip_width;  ///< m
  std::optional<double> strip_angle;  ///< degrees, instead
  std::optional<double> strip_depth;  ///< m
  std::optional<double> cut_depth;    ///< m
  std::optional<double> cut_width;    ///< m; absent: across the block
  double rake_angle = 0;              ///< degrees
  double clearance_angle = 10;        ///< degrees
  double tool_friction = 0.3;
};

struct FeatureCase {  ///< what the scene may leave out
  bool rotation = true, plasticity = true, breakage = true, new_contacts = true, energy_ledger = true;
};

/// Where the material of a run comes from, if it has a table over the confinement.
struct MaterialNote {
  std::string from;     ///< which values of the table; empty: the same at every confinement
  std::string values;   ///< of the keys that the table changes
  std::string warning;  ///< empty: the table has an answer
};

struct Case {
  std::filesystem::path source;               ///< the case file
  std::vector<std::filesystem::path> inputs;  ///< all that was read: the case, its preset, its specimen
  SpecimenCase specimen;
  std::string preset;                        ///< name of the material preset; empty: none
  std::vector<Material> materials;           ///< one per confinement, in the order of test.confinement
  std::vector<MaterialNote> material_notes;  ///< one per confinement
  std::vector<GroupCase> groups;
  BondsCase bonds;
  DampingCase damping;
  FeatureCase features;
  TestCase test;
  std::string accuracy = "normal";
  double safety = 0.8;
  bool mass_scaling = false;
  double mass_factor = 1.5;  ///< of the total mass, where masses are scaled
  ScatterKind scatter = ScatterKind::private_sums;
  Precision precision = Precision::full;
  std::optional<int> search_every;  ///< steps
  double checkpoint_every = 300;    ///< s, wall time
  int frames = 20;
  bool stress = false, cracks = true, orientation = false;  ///< output
  std::string resolved;  ///< the whole case as TOML, every default written out
  std::map<std::string, std::string, std::less<>> places;  ///< "file:line" of each key that is given
  std::vector<std::string> unusual;  ///< lines: defaults that another law, test, dimension or recipe has not
};

/// Reads, checks and resolves a case file.
/// @param file   the case, TOML
/// @param sets   `--set` overrides, each "table.key=value"
/// @param test   name of the program: "ucs", "triaxial", "pack", ... (some keys belong to some
///         tests only)
/// @throws BadInput: one line with file, line, key and the nearest valid choice
Case load_case(const std::filesystem::path& file, const std::vector<std::string>& sets,
               const std::string& test);

/// "file:line" of a key, or the case's file where it was not given.
std::string place_of(const Case& c, std::string_view key);

}  // namespace breccia
