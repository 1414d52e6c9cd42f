// Single precision, bond by bond: random states of every branch of every law against the loop in
// doubles.
#include <doctest/doctest.h>

#include <map>
#include <random>

#include "core/world/single_precision.hpp"
#include "core/world/sync.hpp"
#include "tests/scene.hpp"

using namespace breccia;
namespace ref = breccia::reference;

namespace {

/// Pairs of spheres far from each other, along directions of all kinds.
Assembly pairs(std::size_t count, const Vec3& origin, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  Assembly a;
  a.body = {Shape::cylinder, 1.0, 0.0, 1.0};
  ParticleTable& p = a.particles;
  p.resize(2 * count, Features{});
  p.free = a.first_top = p.size;
  BondTable& b = a.bonds;
  b.resize(count, Features{}, bond_batch);
  const double r = 0.004;
  for (std::size_t k = 0; k < b.padded; ++k) {
    const std::size_t pair = std::min(k, count - 1);
    // the smaller id is in the larger row of every other pair
    const Row first = static_cast<Row>(2 * pair), second = first + 1;
    const bool swapped = pair % 2 == 1;
    if (k < count) {
      Vec3 branch{uniform(random), uniform(random), uniform(random)};
      const double length = 2 * r * (1 + 0.05 * uniform(random));
      branch = (length / norm(branch)) * branch;
      const double place = 0.02 * static_cast<double>(pair % 100);
      p.position[first] =
          origin + Vec3{place, 0.02 * static_cast<double>(pair / 100), 0.01 * uniform(random)};
      p.position[second] = p.position[first] + branch;
      for (const Row row : {first, second}) {
        p.gid[row] = swapped ? 4 * pair + (row == first ? 1 : 0) : 4 * pair + (row == first ? 0 : 1);
        p.radius[row] = r;
        p.reference_position[row] = p.position[row];
      }
    }
    b.row_lo[k] = swapped ? second : first, b.row_hi[k] = swapped ? first : second;
    b.gid_lo[k] = p.gid[b.row_lo[k]], b.gid_hi[k] = p.gid[b.row_hi[k]];
    b.rest_length[k] = norm(p.position[second] - p.position[first]);
    b.area[k] = k < b.size ? std::numbers::pi * r * r * (1 + 0.3 * uniform(random)) : 0.0;
  }
  a.mean_radius = r;
  a.range = 0.2;
  return a;
}

/// A law, with what a state may be: stretches, and limits of forces.
struct Kind {
  std::string name;
  Material material;
  double ratio = 0.33;
};

/// As many times over as BRECCIA_REPEAT says: 40 make 10^7 states.
std::vector<Kind> repeated(const std::vector<Kind>& kinds) {
  const char* times = std::getenv("BRECCIA_REPEAT");
  std::vector<Kind> all;
  for (int k = times ? std::atoi(times) : 1; k > 0; --k) all.insert(all.end(), kinds.begin(), kinds.end());
  return all;
}

std::vector<Kind> every_law() {
  ref::Parameters p;
  p.alpha = 1;
  const Material dempack = scene::material_of(p);
  std::vector<Kind> kinds{{"dempack", dempack}};
  kinds.push_back({"dempack, coupled", dempack});
  kinds.back().material.criterion = Criterion::coupled;
  kinds.push_back({"dempack, fracture energy, Mohr-Coulomb", dempack});
  kinds.back().material.criterion = Criterion::mohr_coulomb;
  kinds.back().material.fracture_energy_normal = 40;
  kinds.back().material.fracture_energy_shear = 400;
  kinds.push_back({"dempack, unloads elsewhere", dempack});
  kinds.back().material.unloading_modulus = 1.7 * dempack.young_modulus;
  kinds.back().material.yield_stress = 1.5 * dempack.limit_compressive_stress[0];
  kinds.push_back({"exponential", dempack});
  kinds.back().material.law = "exponential";
  kinds.back().material.own = {{"elastic_strain_limit", 0.002},
                               {"hardening_factor", 0.2},
                               {"hardening_rate", 16},
                               {"hardening_floor", 0.275}};
  kinds.push_back({"kdem", dempack});
  kinds.back().material.law = "kdem";
  kinds.back().material.own = {{"normal_factor", 1.3}, {"shear_factor", 0.7}};
  kinds.push_back({"contact-bond", dempack});
  kinds.back().material.law = "contact-bond";
  kinds.back().material.own = {{"normal_stiffness", 2e8},
                               {"shear_stiffness", 5e7},
                               {"normal_strength", 250},
                               {"bond_shear_strength", 900}};
  return kinds;
}

/// Puts pairs into random states: stretched and pressed beyond every limit, slipping and twisting,
/// whole, damaged and broken.
void shake(World& w, double displacement, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto some = [&](double size) {
    return Vec3{size * uniform(random), size * uniform(random), size * uniform(random)};
  };
  ParticleTable& p = w.particles;
  BondTable& b = w.bonds;
  const bool plastic = w.features.plasticity;
  const bool brittle = std::holds_alternative<ContactBondLaw>(w.laws.front());
  if (!plastic) b.plastic_stretch.clear();
  for (std::size_t k = 0; k < b.size; ++k) {
    const Row lo = b.row_lo[k], hi = b.row_hi[k];
    const double length = b.rest_length[k];
    const Vec3 axis = (1 / length) * (p.position[hi] - p.position[lo]);
    const Vec3 moved = some(displacement);
    p.position[lo] += moved;
    const double strain = uniform(random) > 0 ? -8e-3 * std::abs(uniform(random)) : 6e-4 * uniform(random);
    const Vec3 across = some(2e-4 * length);
    p.position[hi] += moved + (strain * length) * axis + across;
    for (const Row row : {lo, hi}) {
      p.velocity[row] = some(1e-5 * length / w.dt);
      p.spin[row] = some(1e-5 / w.dt);
    }
    const double strength = 24e6 * b.area[k];
    const Vec3 x = p.position[hi] - p.position[lo], n = (1 / norm(x)) * x;
    Vec3 shear = some(1.5 * strength);
    shear -= dot(shear, n) * n;
    b.shear_x[k] = shear.x, b.shear_y[k] = shear.y, b.shear_z[k] = shear.z;
    const double kind = uniform(random);
    const double part = brittle ? 1.0 : std::abs(uniform(random));
    b.damage_normal[k] = kind > 0.8 ? 1.0 : kind > 0.4 ? part : 0.0;
    b.damage_shear[k] = kind < -0.8 ? 1.0 : kind < -0.4 ? part : 0.0;
    if (plastic && uniform(random) > 0) b.plastic_stretch[k] = -3e-3 * length * std::abs(uniform(random));
  }
}

struct Outcome {
  std::vector<BondLoad> loads;
  BondTable bonds;
};

Outcome in_doubles(World w, const BondPass pass) {
  Outcome out;
  out.loads.resize(w.bonds.padded);
  Scatter to;
  to.mode = ScatterMode::column, to.bond_load = out.loads;
  pass(bond_pass_in(w), bond_pass_history(w), 0, w.bonds.padded, to, nullptr);
  out.bonds = w.bonds;
  return out;
}

/// Last moves are what velocities make of a step.
void fill_moving(World& w) {
  for (std::size_t row = 0; row < w.particles.size; ++row) {
    const double unit = w.single.quanta.motion;
    const Vec3 v = (w.dt / unit) * w.particles.velocity[row];
    w.particles.last_move[row] = {unit * std::nearbyint(v.x), unit * std::nearbyint(v.y),
                                  unit * std::nearbyint(v.z)};
  }
  fill_single(w);
}

/// @param coarser  quantum of force: states may be beyond what a run comes to in one step
Outcome in_single(World w, double coarser) {
  w.single.quanta.force *= coarser;
  fill_moving(w);
  Outcome out;
  std::vector<LoadApart> apart;
  const unsigned events =
      w.single_pass(single_pass_in(w), 0, bond_block * w.single.bonds.size(), nullptr, apart);
  CHECK((events & force_is_lost) == 0);
  sync(w);
  for (std::size_t k = 0; k < w.bonds.size; ++k) {
    const IntegerSums& s = w.single.sums[w.bonds.row_lo[k]];
    const double f = w.single.quanta.force, m = f * w.particles.radius[w.bonds.row_lo[k]];
    out.loads.push_back({{f * s.force[0], f * s.force[1], f * s.force[2]},
                         {m * s.moment[0], m * s.moment[1], m * s.moment[2]}});
  }
  out.bonds = w.bonds;
  return out;
}

}  // namespace

TEST_CASE(
    "single precision: forces and histories of random states as in doubles [1e-5 of the strength, every "
    "law]") {
  std::mt19937_64 random(7);
  std::map<std::string, double> worst_of_law;
  for (const Kind& kind : repeated(every_law()))
    for (const InstructionSet set : scene::sets_of_this_machine())
      for (const double origin : {0.0, 1e6}) {
        CAPTURE(kind.name);
        CAPTURE(name_of(set));
        CAPTURE(origin);
        ref::Parameters p;
        WorldOptions o = scene::options(p);
        o.precision = Precision::single;
        o.instruction_set = set;
        o.features.criterion = kind.material.criterion;
        o.features.plasticity = kind.material.law != "kdem" && kind.material.law != "contact-bond";
        AreaFactor f;
        f.alpha = 1, f.shear_ratio = kind.ratio;
        World w = make_world(pairs(6000, {origin, 0, 0}, random), kind.material, f, o);
        shake(w, 1e-3, random);
        const Outcome want = in_doubles(w, bond_pass_for(w.laws.front(), w.features, set)),
                      got = in_single(w, 16.0);
        std::size_t damaged = 0, yielded = 0, other_branch = 0;
        double worst_force = 0, worst_moment = 0, worst_history = 0, worst_plastic = 0;
        for (std::size_t k = 0; k < w.bonds.size; ++k) {
          const auto state = [&](const BondTable& b) { return b.damage_normal[k] + b.damage_shear[k]; };
          const bool same_bonds = bond_state(want.bonds, k) == bond_state(got.bonds, k);
          if (!same_bonds || std::abs(state(want.bonds) - state(got.bonds)) > 1e-3) {
            ++other_branch;  // a limit met to the last digits
            continue;
          }
          damaged += state(want.bonds) > 0;
          const double strength = std::max(24e6 * w.bonds.area[k], norm(want.loads[k].force));
          const auto apart = [&](const Vec3& a, const Vec3& b) { return norm(a - b) / strength; };
          worst_force = std::max(worst_force, apart(want.loads[k].force, got.loads[k].force));
          worst_moment = std::max(
              worst_moment, apart((0.5 / 0.004) * want.loads[k].moment, (1 / 0.004) * got.loads[k].moment));
          const auto shear = [&](const BondTable& b) {
            return Vec3{b.shear_x[k], b.shear_y[k], b.shear_z[k]};
          };
          worst_history = std::max(worst_history, apart(shear(want.bonds), shear(got.bonds)));
          if (w.bonds.plastic_stretch.empty() ||
              !(want.bonds.plastic_stretch[k] < w.bonds.plastic_stretch[k]))
            continue;
          ++yielded;
          worst_plastic =
              std::max(worst_plastic, std::abs(want.bonds.plastic_stretch[k] - got.bonds.plastic_stretch[k]) /
                                          w.bonds.rest_length[k]);
        }
        double& worst = worst_of_law[kind.name];
        worst = std::max({worst, worst_force, worst_moment, worst_history});
        CHECK(other_branch <= 2);
        CHECK(damaged > w.bonds.size / 4);
        if (o.features.plasticity) CHECK(yielded > w.bonds.size / 20);
        CHECK(worst_force < 1e-5);
        CHECK(worst_moment < 1e-5);
        CHECK(worst_history < 1e-5);
        CHECK(worst_plastic < 1e-6);  // of the stretch
      }
  for (const auto& [law, worst] : worst_of_law) MESSAGE(law, ": ", worst, " of the strength at most");
}

TEST_CASE(
    "single precision: elongation after 1 mm, 10^6 m from the origin [1e-6 of the stretch at failure]") {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const InstructionSet set : scene::sets_of_this_machine()) {
    ref::Parameters p;
    WorldOptions o = scene::options(p);
    o.precision = Precision::single;
    o.instruction_set = set;
    AreaFactor f;
    f.alpha = 1, f.shear_ratio = 0.33;
    World w = make_world(pairs(2000, {1e6, 0, 0}, random), scene::material_of(p), f, o);
    BondTable& b = w.bonds;
    for (std::size_t k = 0; k < b.size; ++k) {
      const Row lo = b.row_lo[k], hi = b.row_hi[k];
      ParticleTable& t = w.particles;
      const Vec3 branch = t.position[hi] - t.position[lo],
                 moved{1e-3 * uniform(random), 1e-3, 1e-3 * uniform(random)};
      t.position[lo] += moved;
      t.position[hi] = t.position[lo] + (1 + 1e-4 * uniform(random)) * branch;
    }
    const Outcome got = in_single(w, 1.0);
    double worst = 0;
    for (std::size_t k = 0; k < b.size; ++k) {
      const Vec3 branch = w.particles.position[b.row_hi[k]] - w.particles.position[b.row_lo[k]];
      const double pull = dot(got.loads[k].force, branch) / norm(branch);
      const double failure = p.sigma_t * b.area[k];
      worst = std::max(worst, std::abs(pull - b.stiffness[k] * (norm(branch) - b.rest_length[k])) / failure);
    }
    CHECK(worst < 1e-6);
    CHECK(worst > 1e-10);
  }
}

TEST_CASE(
    "single precision: a quantum of force that is too fine becomes coarser, and the forces stay [1e-5]") {
  std::mt19937_64 random(5);
  ref::Parameters p;
  WorldOptions o = scene::options(p);
  o.precision = Precision::single;
  AreaFactor f;
  f.alpha = 1, f.shear_ratio = 0.33;
  World w = make_world(pairs(500, {}, random), scene::material_of(p), f, o);
  shake(w, 0.0, random);
  const Outcome want = in_doubles(w, bond_pass_for(w.laws.front(), w.features, o.instruction_set));
  w.single.quanta.force *= 0x1p-4;
  World fine = w;
  fill_moving(fine);
  std::vector<LoadApart> apart;
  CHECK((fine.single_pass(single_pass_in(fine), 0, bond_block * fine.single.bonds.size(), nullptr, apart) &
         force_is_large) != 0);
  REQUIRE(apart.size() > 10);
  for (const LoadApart& load : apart) {  // each pair has rows of its own, in the sums as it was: nothing
    const double quantum = fine.single.quanta.force;
    const std::size_t k = load.near / 2;
    CHECK(fine.single.sums[load.near].force[0] == 0);
    const double sign = w.bonds.row_lo[k] == load.near ? quantum : -quantum;
    CHECK(norm(sign * Vec3{load.force[0], load.force[1], load.force[2]} - want.loads[k].force) <=
          1e-5 * norm(want.loads[k].force));
  }
  fill_single(w);
  coarsen_force(w.single, w.laws);
  coarsen_force(w.single, w.laws);
  const SingleStore coarse = w.single;
  w.single.quanta = coarse.quanta;
  const Outcome got = in_single(w, 64.0);
  for (std::size_t k = 0; k < w.bonds.size; ++k)
    CHECK(norm(want.loads[k].force - got.loads[k].force) <=
          1e-5 * std::max(24e6 * w.bonds.area[k], norm(want.loads[k].force)));
  // the blocks that were scaled are those that are made anew for the coarser quantum
  const auto same = [](const auto& a, const auto& b) {
    return std::equal(std::begin(a), std::end(a), std::begin(b));
  };
  fill_single(w);
  for (std::size_t k = 0; k < coarse.bonds.size(); ++k) {
    CHECK(same(coarse.bonds[k].stiffness, w.single.bonds[k].stiffness));
    CHECK(same(coarse.bonds[k].area, w.single.bonds[k].area));
    CHECK(same(coarse.bonds[k].damping, w.single.bonds[k].damping));
    CHECK(same(coarse.rare[k].strength_area, w.single.rare[k].strength_area));
  }
  CHECK(coarse.coarsenings == 2);
}
