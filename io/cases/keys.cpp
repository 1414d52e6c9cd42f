// The keys of a case, one declaration each, in the order of the resolved case.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <deque>

#include "io/cases/keys_schema.hpp"
#include "kernels/laws/bond_laws.hpp"

namespace breccia {
namespace {

constexpr Range more_than(double low) { return {.low = low, .low_open = true}; }
constexpr Range at_least(double low) { return {.low = low}; }
constexpr Range between(double low, double high) { return {low, high, true, true}; }
constexpr Range from_to_below(double low, double high) { return {low, high, false, true}; }
constexpr Range more_than_to(double low, double high) { return {low, high, true, false}; }
constexpr Range from_to(double low, double high) { return {low, high, false, false}; }

Shape shape_of(std::string_view word) {
  return word == "disc" ? Shape::disc : word == "box" ? Shape::box : Shape::cylinder;
}

SizeDistribution::Kind sizes_of(std::string_view word) {
  using enum SizeDistribution::Kind;
  return word == "uniform" ? uniform : word == "sieves" ? sieves : lognormal;
}

AlphaRule alpha_of(std::string_view word) {
  using enum AlphaRule;
  return word == "auto" ? automatic : word == "affine" ? affine : word == "porosity" ? porosity : number;
}

Criterion criterion_of(std::string_view word) {
  using enum Criterion;
  return word == "coupled" ? coupled : word == "mohr-coulomb" ? mohr_coulomb : uncoupled;
}

ShearUnderYield shear_under_yield_of(std::string_view word) {
  return word == "elastic" ? ShearUnderYield::elastic : ShearUnderYield::tangent;
}

DampingScheme scheme_of(std::string_view word) {
  using enum DampingScheme;
  return word == "capped" ? capped : word == "summed" ? summed : explicit_;
}

ScatterKind scatter_of(std::string_view word) {
  using enum ScatterKind;
  return word == "atomic" ? atomic : word == "gather" ? gather : private_sums;
}

AreaRule area_of(std::string_view word) {
  using enum AreaRule;
  return word == "harmonic"     ? harmonic
         : word == "cone"       ? cone
         : word == "polyhedron" ? polyhedron
         : word == "voronoi"    ? voronoi
                                : minimum;
}

/// A packing is asked for as soon as one of its keys is given.
PackRequest& pack_of(Case& c) {
  if (!c.specimen.pack) c.specimen.pack.emplace();
  return *c.specimen.pack;
}

/// A default that only some tests have.
constexpr std::optional<std::string_view> own_default(bool has, std::string_view text) {
  return has ? std::optional(text) : std::nullopt;
}

/// Whether test.confinement acts on the lateral surface.
constexpr bool presses_sides(const LaboratoryTest& t) {
  return t.pressure == PressureRole::lateral || t.loading == Loading::hydrostatic;
}

constexpr std::array<double, 3> three(const std::vector<double>& v) { return {v[0], v[1], v[2]}; }

// clang-format off: a declaration reads best in few lines
using C = Case;
using M = Material;
using R = Reading;
using T = LaboratoryTest;
constexpr std::array keys{
    // --- the specimen
    Key{.name = "specimen.file",
        .kind = Kind::text,
        .packs = false,
        .reason = "breccia-pack makes the specimen",
        .meaning = "spheres, .csv (id,x_m,y_m,z_m,r_m) or .mdpa, from the case's folder",
        .store = [](C& c, const R& r) { c.specimen.file = r.word; }},
    Key{.name = "specimen.sha256",
        .kind = Kind::text,
        .packs = false,
        .reason = "breccia-pack makes the specimen",
        .meaning = "of the file; a run is refused where it has changed since",
        .store = [](C& c, const R& r) { c.specimen.sha256 = r.word; }},
    Key{.name = "specimen.shape",
        .kind = Kind::word,
        .default_text = "cylinder",
        .default_of = [](const T& t) { return own_default(!t.cylinder, t.box ? "box" : "disc"); },
        .default_2d = "box",
        .words = "cylinder disc box",
        .meaning = "of the nominal body; in 2-D box if not given",
        .store = [](C& c, const R& r) { c.specimen.body.shape = shape_of(r.word); }},
    Key{.name = "specimen.dimensions",
        .kind = Kind::whole_number,
        .default_text = "3",
        .default_of = [](const T& t) { return own_default(!t.three_d, "2"); },
        .range = {2, 3, false, false},
        .meaning = "2: discs 1 m thick in a plane; box: a rectangle, disc: a circle",
        .store = [](C& c, const R& r) { c.specimen.space = r.whole == 2 ? Space::two_d : Space::three_d; }},
    Key{.name = "specimen.axis",
        .kind = Kind::word,
        .default_text = "z",
        .words = "x y z",
        .meaning = "of the cylinder or disc, in the file; in 2-D the direction of loading",
        .store = [](C& c, const R& r) { c.specimen.axis = r.word[0]; }},
    Key{.name = "specimen.diameter",
        .dimension = dimension::length,
        .range = more_than(0),
        .meaning = "nominal: areas and strains use it; of a box its width along x",
        .store = [](C& c, const R& r) { c.specimen.body.diameter = r.number; }},
    Key{.name = "specimen.depth",
        .dimension = dimension::length,
        .range = more_than(0),
        .meaning = "of a box, along y; none in 2-D",
        .store = [](C& c, const R& r) { c.specimen.body.depth = r.number; }},
    Key{.name = "specimen.height",
        .dimension = dimension::length,
        .range = more_than(0),
        .meaning = "along the axis; of a disc its thickness (none in 2-D)",
        .store = [](C& c, const R& r) { c.specimen.body.height = r.number; }},
    Key{.name = "specimen.hole",
        .dimension = dimension::length,
        .range = more_than(0),
        .meaning = "diameter of a round hole along the axis: stresses are over what is left of the section; "
                   "a packing "
                   "made here is drilled",
        .store = [](C& c, const R& r) { c.specimen.body.hole = r.number; }},
    Key{.name = "specimen.centre",
        .kind = Kind::quantities,
        .dimension = dimension::length,
        .count = 3,
        .meaning = "of the body in the file, instead of the middle of the box around the spheres",
        .store =
            [](C& c, const R& r) {
              c.specimen.centre = Vec3{r.numbers[0], r.numbers[1], r.numbers[2]};
            }},
    Key{.name = "specimen.pack.spheres",
        .kind = Kind::whole_number,
        .range = {1, static_cast<double>(pack_limits::most_spheres), false, false},
        .meaning = "number of spheres, in 2-D of discs, to pack; of sieves it follows: leave it out",
        .store = [](C& c, const R& r) { pack_of(c).spheres = static_cast<std::size_t>(r.whole); }},
    Key{.name = "specimen.pack.porosity",
        .default_text = "0.26",
        .default_2d = "0.11",
        .range = from_to(pack_limits::least_porosity_of_plane, pack_limits::most_porosity),
        .where = {"specimen.dimensions", "3",
                  from_to(pack_limits::least_porosity, pack_limits::most_porosity)},
        .meaning = "1 - sum of sphere volumes/body volume: overlaps count twice; beside genesis_pressure: at "
                   "the start",
        .store = [](C& c, const R& r) { pack_of(c).porosity = r.number; }},
    Key{.name = "specimen.pack.genesis_pressure",
        .range = more_than_to(0, pack_limits::most_genesis_pressure),
        .meaning = "2-D: discs grow until the walls feel this pressure over k_n, sigma_0/k_n",
        .store = [](C& c, const R& r) { pack_of(c).genesis_pressure = r.number; }},
    Key{.name = "specimen.pack.seed",
        .kind = Kind::whole_number,
        .default_text = "1",
        .range = at_least(0),
        .meaning = "another seed, another packing",
        .store = [](C& c, const R& r) { pack_of(c).seed = static_cast<std::uint64_t>(r.whole); }},
    Key{.name = "specimen.pack.sizes.kind",
        .kind = Kind::word,
        .default_text = "lognormal",
        .words = "lognormal uniform sieves",
        .meaning = "distribution of sphere sizes",
        .store = [](C& c, const R& r) { pack_of(c).sizes.kind = sizes_of(r.word); }},
    Key{.name = "specimen.pack.sizes.spread",
        .default_text = "0.26",
        .range = from_to(0, pack_limits::most_spread_uniform),
        .where = {"specimen.pack.sizes.kind", "lognormal", from_to(0, pack_limits::most_spread_lognormal)},
        .meaning = "lognormal: standard deviation of ln r; uniform: half-width over mean",
        .store = [](C& c, const R& r) { pack_of(c).sizes.spread = r.number; }},
    Key{.name = "specimen.pack.sizes.openings",
        .kind = Kind::quantities,
        .dimension = dimension::length,
        .range = more_than(0),
        .rising = true,
        .meaning = "sieves: openings, rising; lengths, so that body and porosity give the number of spheres",
        .store = [](C& c, const R& r) { pack_of(c).sizes.sieve_openings = r.numbers; }},
    Key{.name = "specimen.pack.sizes.passing",
        .kind = Kind::quantities,
        .range = {0, 1, false, false},
        .rising = true,
        .meaning = "sieves: mass fraction passing each opening, rising to 1",
        .store = [](C& c, const R& r) { pack_of(c).sizes.sieve_passing = r.numbers; }},
    Key{.name = "specimen.pack.sizes.finest",
        .dimension = dimension::length,
        .range = more_than(0),
        .meaning = "sieves: what is finer is left out, and what passes counts from there",
        .store = [](C& c, const R& r) { pack_of(c).sizes.finest = r.number; }},

    // --- the material
    Key{.name = "material.preset",
        .kind = Kind::text,
        .meaning = "data/materials/NAME.toml; any key here overrides it",
        .store = [](C& c, const R& r) { c.preset = r.word; }},
    Key{.name = "material.density",
        .dimension = dimension::density,
        .range = more_than(0),
        .meaning = "of the spheres",
        .store_material = [](M& m, const R& r) { m.density = r.number; }},
    Key{.name = "material.young_modulus",
        .dimension = dimension::stress,
        .range = more_than(0),
        .meaning = "of the specimen",
        .store_material = [](M& m, const R& r) { m.young_modulus = r.number; }},
    Key{.name = "material.poisson_ratio",
        .range = from_to_below(0, 0.5),
        .meaning = "of the specimen; at most 0.25 with matched elasticity",
        .store_material = [](M& m, const R& r) { m.poisson_ratio = r.number; }},
    Key{.name = "material.friction_static",
        .range = at_least(0),
        .meaning = "mu_1: growth of the shear strength with pressure on the bond",
        .store_material = [](M& m, const R& r) { m.friction_static = r.number; }},
    Key{.name = "material.friction_dynamic",
        .range = at_least(0),
        .meaning = "mu_2: Coulomb friction of broken bonds and contacts",
        .store_material = [](M& m, const R& r) { m.friction_dynamic = r.number; }},
    Key{.name = "material.rolling_friction",
        .default_text = "0",
        .range = at_least(0),
        .meaning = "mu_r: torque against rolling where no bond is, over r_i r_j/(r_i + r_j) and the force",
        .store_material = [](M& m, const R& r) { m.rolling_friction = r.number; }},
    Key{.name = "material.tensile_strength",
        .dimension = dimension::stress,
        .range = more_than(0),
        .meaning = "of a bond, sigma_t",
        .store_material = [](M& m, const R& r) { m.tensile_strength = r.number; }},
    Key{.name = "material.shear_strength",
        .dimension = dimension::stress,
        .range = more_than(0),
        .meaning = "of a bond, tau_f",
        .store_material = [](M& m, const R& r) { m.shear_strength = r.number; }},
    Key{.name = "material.limit_compressive_stress",
        .kind = Kind::quantities,
        .dimension = dimension::stress,
        .range = more_than(0),
        .count = 3,
        .rising = true,
        .meaning = "LCS 1, 2, 3: where the slope changes",
        .store_material = [](M& m, const R& r) { m.limit_compressive_stress = three(r.numbers); }},
    Key{.name = "material.stiffness_reduction",
        .kind = Kind::quantities,
        .range = at_least(1),
        .count = 3,
        .meaning = "YRC 1, 2, 3: the slope beyond a limit is E/YRC",
        .store_material = [](M& m, const R& r) { m.stiffness_reduction = three(r.numbers); }},
    Key{.name = "material.unloading_modulus",
        .dimension = dimension::stress,
        .range = more_than(0),
        .meaning = "of a bond that has yielded, on its way back; E if not given",
        .store_material = [](M& m, const R& r) { m.unloading_modulus = r.number; }},
    Key{.name = "material.yield_stress",
        .dimension = dimension::stress,
        .range = more_than(0),
        .meaning =
            "where plasticity begins, LCS 1 if not given; between LCS 1 and it a bond goes back the way "
            "it came",
        .store_material = [](M& m, const R& r) { m.yield_stress = r.number; }},
    Key{.name = "material.damage_normal",
        .range = at_least(0),
        .meaning = "delta_n: softening branch over elastic branch",
        .store_material = [](M& m, const R& r) { m.damage_normal = r.number; }},
    Key{.name = "material.damage_shear",
        .range = at_least(0),
        .meaning = "delta_s",
        .store_material = [](M& m, const R& r) { m.damage_shear = r.number; }},
    Key{.name = "material.fracture_energy_normal",
        .dimension = dimension::energy_per_area,
        .range = more_than(0),
        .instead_of = "material.damage_normal",
        .meaning = "G_I, instead of damage_normal",
        .store_material = [](M& m, const R& r) { m.fracture_energy_normal = r.number; }},
    Key{.name = "material.fracture_energy_shear",
        .dimension = dimension::energy_per_area,
        .range = more_than(0),
        .instead_of = "material.damage_shear",
        .meaning = "G_II, instead of damage_shear",
        .store_material = [](M& m, const R& r) { m.fracture_energy_shear = r.number; }},
    Key{.name = "material.failure_strain_normal",
        .range = more_than(0),
        .instead_of = "material.damage_normal",
        .meaning = "eps_f, strain at which tension has softened to nothing, instead of damage_normal",
        .store_material = [](M& m, const R& r) { m.failure_strain_normal = r.number; }},
    Key{.name = "material.failure_strain_shear",
        .range = more_than(0),
        .instead_of = "material.damage_shear",
        .meaning = "gamma_f, the same of shear, instead of damage_shear",
        .store_material = [](M& m, const R& r) { m.failure_strain_shear = r.number; }},
    Key{.name = "material.shear_residual",
        .kind = Kind::word,
        .default_text = "friction",
        .words = "friction zero",
        .meaning = "what shear softens to before Coulomb friction takes over",
        .store_material = [](M& m, const R& r) { m.softens_to_zero = r.word == "zero"; }},
    Key{.name = "material.law",
        .kind = Kind::word,
        .default_text = "dempack",
        .meaning = "of the bonds",
        .store_material = [](M& m, const R& r) { m.law = r.word; }},
    Key{.name = "material.criterion",
        .kind = Kind::word,
        .default_text = "uncoupled",
        .words = "uncoupled coupled mohr-coulomb",
        .meaning = "how tension and shear share a bond's strength",
        .store_material = [](M& m, const R& r) { m.criterion = criterion_of(r.word); }},
    Key{.name = "material.contact_law",
        .kind = Kind::word,
        .default_text = "linear",
        .words = "linear hertz-mindlin",
        .meaning = "of surfaces that were never bonded",
        .store_material =
            [](M& m, const R& r) {
              m.contact_law = r.word == "linear" ? ContactLaw::linear : ContactLaw::hertz_mindlin;
            }},
    Key{.name = "material.limits",
        .kind = Kind::word,
        .default_text = "bond",
        .words = "bond macroscopic",
        .meaning = "limit_compressive_stress is one of bonds, or of a specimen under even pressure",
        .store_material =
            [](M& m, const R& r) {
              m.limits = r.word == "macroscopic" ? LimitStress::macroscopic : LimitStress::bond;
            }},
    Key{.name = "material.shear_under_yield",
        .kind = Kind::word,
        .default_text = "tangent",
        .words = "tangent elastic",
        .meaning = "k_s of a bond whose compression yields: falls as its tangent does, or stays",
        .store_material = [](M& m, const R& r) { m.shear_under_yield = shear_under_yield_of(r.word); }},

    // --- bonds
    Key{.name = "bonds.range",
        .default_text = "0.1",
        .range = between(-0.5, 1),
        .meaning = "beta: bonded where the distance is at most (1 + beta)(r_i + r_j)",
        .store = [](C& c, const R& r) { c.bonds.range = r.number; }},
    Key{.name = "bonds.coordination",
        .range = between(0, 30),
        .instead_of = "bonds.range",
        .meaning = "bonds per sphere to aim at, instead of range",
        .store = [](C& c, const R& r) { c.bonds.coordination = r.number; }},
    Key{.name = "bonds.alpha",
        .kind = Kind::word_or_number,
        .default_text = "auto",
        .range = more_than(0),
        .words = "auto affine porosity",
        .meaning = "area factor; auto: an elastic probe finds it",
        .store = [](C& c, const R& r) { c.bonds.alpha_rule = alpha_of(r.word), c.bonds.alpha = r.number; }},
    Key{.name = "bonds.elasticity",
        .kind = Kind::word,
        .default_text = "paper",
        .words = "paper matched",
        .meaning = "matched: the specimen has the E and the nu asked for",
        .store =
            [](C& c, const R& r) {
              c.bonds.elasticity = r.word == "matched" ? Elasticity::matched : Elasticity::paper;
            }},
    Key{.name = "bonds.area",
        .kind = Kind::word,
        .default_text = "minimum",
        .words = "minimum harmonic cone polyhedron voronoi",
        .meaning =
            "pi min(r)^2, pi (harmonic mean)^2, pi r_i r_j, share of a virtual polyhedron, Voronoi face",
        .store = [](C& c, const R& r) { c.bonds.area = area_of(r.word); }},
    Key{.name = "bonds.strength_area",
        .kind = Kind::word,
        .default_text = "same",
        .words = "same minimum harmonic cone polyhedron voronoi",
        .meaning = "that strengths stand on; same: alpha times the area; others as they are",
        .store =
            [](C& c, const R& r) {
              c.bonds.strength_area.reset();
              if (r.word != "same") c.bonds.strength_area = area_of(r.word);
            }},

    Key{.name = "bonds.between_groups",
        .kind = Kind::boolean,
        .default_text = "false",
        .meaning = "spheres of different groups are bonded too; true where a [[material.group]] is given",
        .store = [](C& c, const R& r) { c.bonds.between_groups = r.flag; }},

    // --- damping
    Key{.name = "damping.contact",
        .default_text = "0.9",
        .range = from_to_below(0, 1),
        .meaning = "xi, fraction of critical, along the bond",
        .store = [](C& c, const R& r) { c.damping.contact = r.number; }},
    Key{.name = "damping.form",
        .kind = Kind::word,
        .default_text = "critical",
        .words = "critical paper",
        .meaning = "paper: times pi alpha r_c/d0",
        .store = [](C& c, const R& r) { c.damping.paper_form = r.word == "paper"; }},
    Key{.name = "damping.scheme",
        .kind = Kind::word,
        .default_text = "explicit",
        .words = "explicit capped summed",
        .meaning =
            "capped, summed: dashpots held back where they shorten the step; strengths change by a few %",
        .store = [](C& c, const R& r) { c.damping.scheme = scheme_of(r.word); }},
    Key{.name = "damping.translation",
        .default_text = "0.1",
        .range = from_to_below(0, 1),
        .meaning = "non-viscous, fraction of the force",
        .store = [](C& c, const R& r) { c.damping.translation = r.number; }},
    Key{.name = "damping.viscous_rate",
        .dimension = Dimension{0, 0, -1},
        .range = at_least(0),
        .instead_of = "damping.translation",
        .meaning = "viscous global damping: what a momentum loses of itself, instead of fractions of forces",
        .store = [](C& c, const R& r) { c.damping.viscous_rate = r.number; }},
    Key{.name = "damping.rotation",
        .default_text = "0.1",
        .range = from_to_below(0, 1),
        .meaning = "non-viscous, fraction of the torque",
        .store = [](C& c, const R& r) { c.damping.rotation = r.number; }},

    // --- the test
    Key{.name = "test.confinement",
        .kind = Kind::quantities,
        .dimension = dimension::stress,
        .default_text = "0 Pa",
        .default_of = [](const T& t) { return own_default(t.pressure == PressureRole::needed, ""); },
        .range = at_least(0),
        .refused_by = [](const T& t) { return t.pressure == PressureRole::none; },
        .reason = "this test sets no pressure",
        .meaning = "one run for each; hydrostatic: reached at the end; shear: on the lid of the box",
        .store = [](C& c, const R& r) { c.test.confinement = r.numbers; }},
    Key{.name = "test.intermediate_stress",
        .kind = Kind::quantities,
        .dimension = dimension::stress,
        .range = more_than(0),
        .refused_by = [](const T& t) { return t.pressure != PressureRole::lateral || t.two_d; },
        .reason = "this test has no pressure that could differ from side to side",
        .meaning = "true triaxial of a box: pressure on its faces normal to x, one or one for each "
                   "confinement, which "
                   "is that on the faces normal to y",
        .store = [](C& c, const R& r) { c.test.intermediate_stress = r.numbers; }},
    Key{.name = "test.hydrostatic_branch",
        .kind = Kind::word,
        .default_text = "elastic",
        .words = "elastic law",
        .refused_by = [](const T& t) { return t.pressure != PressureRole::lateral; },
        .reason = "this test has no pressure before its loading",
        .meaning = "stage 1 loads bonds elastically, and loading starts from there; or by their law",
        .store =
            [](C& c, const R& r) {
              c.test.hydrostatic_branch =
                  r.word == "law" ? HydrostaticResponse::law : HydrostaticResponse::elastic;
            }},
    Key{.name = "test.platens",
        .kind = Kind::word,
        .default_text = "rough",
        .default_of = [](const T& t) { return own_default(t.smooth, "smooth"); },
        .words = "rough smooth",
        .refused_by = [](const T& t) { return t.always_rough; },
        .reason = "this test holds every direction",
        .meaning = "rough: no lateral motion of the end layers",
        .store = [](C& c, const R& r) { c.test.rough_platens = r.word == "rough"; }},
    Key{.name = "test.platen_speed",
        .dimension = dimension::speed,
        .default_text = "0.1 m/s",
        .range = more_than(0),
        .meaning = "of each platen: strain rate 2 v/H; cut: of the tool",
        .store = [](C& c, const R& r) { c.test.platen_speed = r.number; }},
    Key{.name = "test.stop_strain",
        .default_text = "0.02",
        .range = between(0, 1),
        .refused_by = [](const T& t) { return !t.strain_ends_it; },
        .reason = "a hydrostatic test ends at its pressure",
        .meaning =
            "platen travel over H (bts: over D; shear: shift over D; cut: way over D) at which a run ends",
        .store = [](C& c, const R& r) { c.test.stop_strain = r.number; }},
    Key{.name = "test.stop_after_peak",
        .default_text = "0.5",
        .range = from_to_below(0, 1),
        .refused_by = [](const T& t) { return !t.strain_ends_it || t.loading == Loading::cutting; },
        .reason = "this test does not end with a peak",
        .meaning = "fraction of the peak deviator by which it has fallen when a run ends; 0: never",
        .store = [](C& c, const R& r) { c.test.stop_after_peak = r.number; }},
    Key{.name = "test.unload_at",
        .kind = Kind::quantities,
        .range = between(0, 1),
        .rising = true,
        .refused_by = [](const T& t) { return !t.in_cycles; },
        .reason = "this test is not run in cycles",
        .meaning = "platen strains at which the specimen is unloaded, then loaded again",
        .store = [](C& c, const R& r) { c.test.unload_at = r.numbers; }},
    Key{.name = "test.unload_to",
        .default_text = "0.1",
        .range = from_to_below(0, 1),
        .refused_by = [](const T& t) { return !t.in_cycles; },
        .reason = "this test is not run in cycles",
        .meaning = "fraction of the deviator at which loading begins again",
        .store = [](C& c, const R& r) { c.test.unload_to = r.number; }},
    Key{.name = "test.load_axis",
        .kind = Kind::word,
        .words = "x y z",
        .refused_by = [](const T& t) { return !t.across; },
        .packs = false,
        .reason = "loading is along specimen.axis",
        .meaning = "bts: the diameter in the file along which the disc is pressed",
        .store = [](C& c, const R& r) { c.test.load_axis = r.word[0]; }},
    Key{.name = "test.strips",
        .kind = Kind::word,
        .default_text = "layers",
        .words = "layers planes",
        .refused_by = [](const T& t) { return !t.across; },
        .reason = "strips press a disc",
        .meaning = "bts: layers of held spheres, or rigid planes that touch the disc",
        .store = [](C& c, const R& r) { c.test.plane_strips = r.word == "planes"; }},
    Key{.name = "test.strip_width",
        .dimension = dimension::length,
        .range = more_than(0),
        .refused_by = [](const T& t) { return !t.across; },
        .reason = "strips press a disc",
        .meaning = "bts: of each strip, across the load; 0.15 of the diameter if not given",
        .store = [](C& c, const R& r) { c.test.strip_width = r.number; }},
    Key{.name = "test.strip_angle",
        .range = more_than_to(0, 90),
        .instead_of = "test.strip_width",
        .refused_by = [](const T& t) { return !t.across; },
        .reason = "strips press a disc",
        .meaning = "bts: degrees of the rim under each strip, instead of strip_width",
        .store = [](C& c, const R& r) { c.test.strip_angle = r.number; }},
    Key{.name = "test.strip_depth",
        .dimension = dimension::length,
        .range = more_than(0),
        .refused_by = [](const T& t) { return !t.across; },
        .reason = "strips press a disc",
        .meaning = "bts: from the rim, to which held spheres reach; 2.5 mean radii if not given",
        .store = [](C& c, const R& r) { c.test.strip_depth = r.number; }},
    Key{.name = "test.cut_depth",
        .dimension = dimension::length,
        .range = more_than(0),
        .refused_by = [](const T& t) { return t.loading != Loading::cutting; },
        .reason = "only breccia-cut has a tool",
        .meaning = "cut: of the tool's tip below the top of the block; must be given",
        .store = [](C& c, const R& r) { c.test.cut_depth = r.number; }},
    Key{.name = "test.cut_width",
        .dimension = dimension::length,
        .range = more_than(0),
        .refused_by = [](const T& t) { return t.loading != Loading::cutting; },
        .reason = "only breccia-cut has a tool",
        .meaning = "cut: of the tool, across its way; the whole block if not given",
        .store = [](C& c, const R& r) { c.test.cut_width = r.number; }},
    Key{.name = "test.rake_angle",
        .default_text = "0",
        .range = between(-60, 60),
        .refused_by = [](const T& t) { return t.loading != Loading::cutting; },
        .reason = "only breccia-cut has a tool",
        .meaning = "cut: degrees of the tool's front face from the vertical; positive: it leans back",
        .store = [](C& c, const R& r) { c.test.rake_angle = r.number; }},
    Key{.name = "test.clearance_angle",
        .default_text = "10",
        .range = between(0, 60),
        .refused_by = [](const T& t) { return t.loading != Loading::cutting; },
        .reason = "only breccia-cut has a tool",
        .meaning = "cut: degrees of the tool's flank from the horizontal",
        .store = [](C& c, const R& r) { c.test.clearance_angle = r.number; }},
    Key{.name = "test.tool_friction",
        .default_text = "0.3",
        .range = at_least(0),
        .refused_by = [](const T& t) { return t.loading != Loading::cutting; },
        .reason = "only breccia-cut has a tool",
        .meaning = "cut: Coulomb, of the tool on spheres",
        .store = [](C& c, const R& r) { c.test.tool_friction = r.number; }},
    Key{.name = "test.skin_weights",
        .kind = Kind::word,
        .default_text = "radius",
        .words = "radius voronoi",
        .refused_by = [](const T& t) { return !presses_sides(t); },
        .reason = "nothing presses on the lateral surface",
        .meaning =
            "what pressure on a sphere of the lateral surface acts on: pi r^2, scaled, or its Voronoi face",
        .store =
            [](C& c, const R& r) {
              c.test.skin_weights = r.word == "voronoi" ? SkinWeights::voronoi : SkinWeights::radius;
            }},

    Key{.name = "test.surface",
        .kind = Kind::word,
        .default_text = "initial",
        .words = "initial current",
        .refused_by = [](const T& t) { return !presses_sides(t); },
        .reason = "nothing presses on the lateral surface",
        .meaning = "that the confinement acts on: as it was, or as it is",
        .store = [](C& c, const R& r) { c.test.current_surface = r.word == "current"; }},

    // --- time, run, features, output
    Key{.name = "time.accuracy",
        .kind = Kind::word,
        .default_text = "normal",
        .words = "fast normal reference",
        .meaning = "measured recipe for what the case does not name",
        .store = [](C& c, const R& r) { c.accuracy = r.word; }},
    Key{.name = "time.safety",
        .default_text = "0.8",
        .range = more_than_to(0, 1),
        .meaning = "of the critical step",
        .store = [](C& c, const R& r) { c.safety = r.number; }},
    Key{.name = "time.mass_scaling",
        .kind = Kind::boolean,
        .default_text = "false",
        .meaning = "heavier small spheres, a larger step; for quasi-static tests",
        .store = [](C& c, const R& r) { c.mass_scaling = r.flag; }},
    Key{.name = "time.mass_factor",
        .default_text = "1.5",
        .range = more_than(1),
        .meaning = "with mass_scaling: total mass over the true one, at most",
        .store = [](C& c, const R& r) { c.mass_factor = r.number; }},
    Key{.name = "run.scatter",
        .kind = Kind::word,
        .default_text = "private",
        .words = "private atomic gather",
        .meaning = "how forces are summed between threads; gather: the same bits for any number of them",
        .store = [](C& c, const R& r) { c.scatter = scatter_of(r.word); }},
    Key{.name = "run.precision",
        .kind = Kind::word,
        .default_text = "single",
        .words = "single double",
        .meaning = "single: the loop over bonds in floats, motion and sums as integers; the same bits for "
                   "any number of threads and ranks. Default double with resistance to rolling",
        .store = [](C& c,
                    const R& r) { c.precision = r.word == "single" ? Precision::single : Precision::full; }},
    Key{.name = "run.search_every",
        .kind = Kind::whole_number,
        .range = {1, 1e9, false, false},
        .meaning = "steps between two searches for contacts; if not given, whenever the skin is used up",
        .store = [](C& c, const R& r) { c.search_every = static_cast<int>(r.whole); }},
    Key{.name = "run.checkpoint_every",
        .dimension = dimension::time,
        .default_text = "5 min",
        .range = more_than(0),
        .meaning = "wall time between checkpoints",
        .store = [](C& c, const R& r) { c.checkpoint_every = r.number; }},
    Key{.name = "features.rotation",
        .kind = Kind::boolean,
        .default_text = "true",
        .meaning = "spheres spin",
        .store = [](C& c, const R& r) { c.features.rotation = r.flag; }},
    Key{.name = "features.plasticity",
        .kind = Kind::boolean,
        .default_text = "true",
        .meaning = "three-slope envelope in compression",
        .store = [](C& c, const R& r) { c.features.plasticity = r.flag; }},
    Key{.name = "features.breakage",
        .kind = Kind::boolean,
        .default_text = "true",
        .meaning = "bonds are damaged and fail",
        .store = [](C& c, const R& r) { c.features.breakage = r.flag; }},
    Key{.name = "features.new_contacts",
        .kind = Kind::boolean,
        .default_text = "true",
        .meaning = "spheres that meet later touch",
        .store = [](C& c, const R& r) { c.features.new_contacts = r.flag; }},
    Key{.name = "features.energy_ledger",
        .kind = Kind::boolean,
        .default_text = "true",
        .meaning = "books where the work goes; gives energy_error",
        .store = [](C& c, const R& r) { c.features.energy_ledger = r.flag; }},
    Key{.name = "output.frames",
        .kind = Kind::whole_number,
        .default_text = "20",
        .range = {0, 1e6, false, false},
        .meaning = "pictures for ParaView of each run; 0: none",
        .store = [](C& c, const R& r) { c.frames = static_cast<int>(r.whole); }},
    Key{.name = "output.stress",
        .kind = Kind::boolean,
        .default_text = "false",
        .meaning = "stress of each particle and nearness to failure of each bond, in every picture",
        .store = [](C& c, const R& r) { c.stress = r.flag; }},
    Key{.name = "output.orientation",
        .kind = Kind::boolean,
        .default_text = "false",
        .meaning = "how each particle has turned, in every picture",
        .store = [](C& c, const R& r) { c.orientation = r.flag; }},
    Key{.name = "output.cracks",
        .kind = Kind::boolean,
        .default_text = "true",
        .meaning = "a row in cracks-K.csv for every bond that breaks, as it breaks",
        .store = [](C& c, const R& r) { c.cracks = r.flag; }},
};
// clang-format on

}  // namespace

namespace {

/// Parameters that the laws declare, as keys of [material].
std::vector<Key> keys_of_laws() {
  static std::deque<std::string> names;
  std::vector<Key> own;
  for_each_law([&](const auto& law) {
    for (const LawParameter& parameter : law.own) {
      Key key;
      key.name = names.emplace_back(fmt::format("material.{}", parameter.key));
      key.dimension = dimension_of(parameter.unit);
      key.range = parameter.above ? more_than(parameter.low) : at_least(parameter.low);
      key.law = law.name;
      key.default_text = parameter.default_text;
      key.meaning = names.emplace_back(fmt::format("law {}: {}", law.name, parameter.meaning));
      own.push_back(key);
    }
  });
  return own;
}

}  // namespace

std::span<const Key> all_keys() {
  static const std::vector<Key> all = [] {
    std::vector<Key> list(keys.begin(), keys.end());
    const auto after =
        std::find_if(list.begin(), list.end(), [](const Key& k) { return k.name == "material.criterion"; });
    static std::string laws;  // the words of material.law are the laws that there are
    for_each_law([](const auto& law) { laws += fmt::format("{}{}", laws.empty() ? "" : " ", law.name); });
    std::find_if(list.begin(), list.end(), [](const Key& k) { return k.name == "material.law"; })->words =
        laws;
    const auto own = keys_of_laws();
    list.insert(after + 1, own.begin(), own.end());
    return list;
  }();
  return all;
}

}  // namespace breccia
