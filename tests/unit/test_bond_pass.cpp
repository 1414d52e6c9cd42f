// One pass over the bonds, for every feature set and instruction set that is built: against the
// reference's pair update, and without a difference of one bit where a difference would have no
// meaning.
#include <doctest/doctest.h>

#include <numeric>
#include <random>

#include "core/stepping/step.hpp"
#include "core/tables/state_hash.hpp"
#include "core/world/energies.hpp"
#include "core/world/make_world.hpp"
#include "tests/scene.hpp"

using namespace breccia;
namespace ref = breccia::reference;

namespace {

/// Bonds in all states between particles that move and spin.
struct Bundle {
  ref::Parameters parameters;
  double dt = 1e-6;
  ParticleTable particles;
  BondTable bonds;
  std::vector<ref::Bond> reference;
};

/// A kernel that is built, and the criterion of the scene that runs in it.
struct Kernel {
  Features features;
  ref::Criterion criterion;
};
/// All of them; a Mohr-Coulomb scene runs in the uncoupled kernels, with a line that falls in
/// tension too.
std::vector<Kernel> kernels() {
  std::vector<Kernel> all;
  for (const Features& f : DempackLaw::feature_sets) {
    all.push_back({f, static_cast<ref::Criterion>(f.criterion)});
    if (f.breakage && f.criterion == Criterion::uncoupled) all.push_back({f, ref::Criterion::mohr_coulomb});
  }
  return all;
}

/// @param follows  shear yields with the compression
Bundle random_bundle(const Kernel& kernel, std::uint64_t seed, bool follows = true) {
  const Features& features = kernel.features;
  Bundle s;
  ref::Parameters& p = s.parameters;
  p.rotation = features.rotation;
  p.contact_damping = features.contact_damping;
  p.plasticity = features.plasticity;
  p.breakage = features.breakage;
  p.criterion = kernel.criterion;
  p.shear_follows = follows;
  p.delta_n = 0.5;
  p.delta_s = 0.4;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> in(-1, 1), unit(0, 1);
  const auto vector = [&](double size) { return size * Vec3{in(random), in(random), in(random)}; };
  constexpr std::size_t particles = 90, bonds = 248;  // the last block of the pass is not a whole one
  s.particles.resize(particles, features);
  for (std::size_t k = 0; k < particles; ++k) {
    s.particles.gid[k] = k;
    s.particles.radius[k] = 0.008 + 0.004 * unit(random);
    s.particles.mass[k] = 0.01 * (1 + unit(random));
    s.particles.position[k] = vector(0.1);
    s.particles.velocity[k] = vector(2);
    if (features.rotation) s.particles.spin[k] = vector(60);
  }
  s.bonds.resize(bonds, features, bond_batch);
  std::uniform_int_distribution<Row> any(0, particles - 1);
  for (std::size_t k = 0; k < bonds; ++k) {
    Row lo = any(random), hi = any(random);
    while (hi == lo) hi = any(random);
    if (lo > hi) std::swap(lo, hi);
    ref::Bond b;
    b.i = lo, b.j = hi;
    const double distance = norm(s.particles.position[hi] - s.particles.position[lo]);
    b.d0 = b.strain_length = distance * (1 + 0.004 * in(random));
    b.area = 3e-4 * (0.5 + unit(random));
    b.k_n = p.E * b.area / b.d0;
    b.k_s = b.k_n / 2.4;
    b.c_n = 0.02 * b.k_n * s.dt * unit(random) * 50;
    b.delta_n = p.delta_n, b.delta_s = p.delta_s;
    const double kind = unit(random), u_l = p.sigma_t * b.area / b.k_n;
    if (kind < 0.6) b.d0 = b.strain_length = distance - (2.5 * in(random)-0.5) * u_l;
    b.k_n = p.E * b.area / b.strain_length, b.k_s = b.k_n / 2.4;
    b.F_s = vector(1.1 * p.tau_f * b.area);
    if (features.plasticity && unit(random) < 0.4) b.u_p = -2 * u_l * unit(random);
    if (features.breakage) {
      const double fate = unit(random);
      if (fate < 0.2)
        b.D_n = 1, b.broken = ref::Broken::tension;
      else if (fate < 0.4)
        b.D_s = 1, b.broken = ref::Broken::shear;
      else if (fate < 0.7) {
        b.D_n = 0.5 * unit(random);
        b.D_s = p.criterion == ref::Criterion::coupled ? b.D_n : 0.5 * unit(random);
      }
    }
    s.reference.push_back(b);
    BondTable& t = s.bonds;
    t.gid_lo[k] = t.row_lo[k] = lo, t.gid_hi[k] = t.row_hi[k] = hi;
    if (features.rotation) {
      const double r_lo = s.particles.radius[lo], r_hi = s.particles.radius[hi];
      t.arm_offset[k] = 0.5 * (r_lo - r_hi) / (r_lo + r_hi);
    }
    t.rest_length[k] = b.d0, t.area[k] = b.area, t.stiffness[k] = b.k_n;
    if (features.contact_damping) t.damping[k] = b.c_n;
    t.shear_x[k] = b.F_s.x, t.shear_y[k] = b.F_s.y, t.shear_z[k] = b.F_s.z;
    if (features.plasticity) t.plastic_stretch[k] = b.u_p;
    if (features.breakage) t.damage_normal[k] = b.D_n, t.damage_shear[k] = b.D_s;
  }
  return s;
}

struct Loads {
  std::vector<BondLoad> load;
};

/// The pass over all bonds into a column; history advances.
Loads pass(Bundle& s, const Features& features, InstructionSet set) {
  BondTable& b = s.bonds;
  const ParticleTable& p = s.particles;
  Loads c{std::vector<BondLoad>(b.padded)};
  Scatter to;
  to.mode = ScatterMode::column;
  to.bond_load = c.load;
  const BondLaw law = scene::law(s.parameters);
  bond_pass_for(law, features, set)({s.dt,
                                     {&law, 1},
                                     p.position,
                                     p.velocity,
                                     p.spin,
                                     b.row_lo,
                                     b.row_hi,
                                     b.rest_length,
                                     constant_columns(b),
                                     b.law},
                                    {history_columns(b), {}}, 0, b.padded, to, nullptr);
  return c;
}

/// Swaps the ends of every bond.
void swap_ends(Bundle& s) {
  BondTable& b = s.bonds;
  std::swap(b.row_lo, b.row_hi);
  std::swap(b.gid_lo, b.gid_hi);
  for (auto* column : {&b.shear_x, &b.shear_y, &b.shear_z, &b.arm_offset})
    for (double& f : *column) f = -f;
}

bool same_history(const BondTable& a, std::size_t k, const BondTable& b, std::size_t l, double sign) {
  return a.shear_x[k] == sign * b.shear_x[l] && a.shear_y[k] == sign * b.shear_y[l] &&
         a.shear_z[k] == sign * b.shear_z[l] &&
         (a.plastic_stretch.empty() || a.plastic_stretch[k] == b.plastic_stretch[l]) &&
         (a.damage_normal.empty() ||
          (a.damage_normal[k] == b.damage_normal[l] && a.damage_shear[k] == b.damage_shear[l]));
}

}  // namespace

TEST_CASE(
    "bond pass: all feature sets and instruction sets as the reference's pair update [random pairs, rel "
    "1e-11; 1e-10 where shear yields]") {
  const auto hold = [](const Kernel& kernel, InstructionSet set, bool follows) {
    const Features& features = kernel.features;
    Bundle s = random_bundle(kernel, 7, follows);
    double force = 0, moment = 0, history = 0;
    int broken = 0, newly_broken = 0;
    for (const ref::Bond& b : s.reference) broken -= b.broken != ref::Broken::no;
    for (int step = 0; step < 6; ++step) {
      const Loads got = pass(s, features, set);
      for (std::size_t k = 0; k < s.bonds.size; ++k) {
        ref::Bond& b = s.reference[k];
        const auto end = [&](std::size_t row) {
          ref::Particle a;
          a.radius = s.particles.radius[row], a.x = s.particles.position[row],
          a.v = s.particles.velocity[row];
          if (features.rotation) a.w = s.particles.spin[row];
          return a;
        };
        ref::Particle i = end(b.i), j = end(b.j);
        ref::update_bond(s.parameters, b, i, j, s.dt);
        const double scale = s.parameters.LCS[0] * b.area;
        const auto worse = [](double& worst, double miss) { worst = miss <= worst ? worst : miss; };
        worse(force, norm(got.load[k].force - i.force) / scale);
        worse(force, norm(got.load[k].force + j.force) / scale);
        if (features.rotation) {
          // ends lie far apart here: arms are up to ten radii
          const double arms = norm(j.x - i.x) / (i.radius + j.radius);
          worse(moment, norm((0.5 + s.bonds.arm_offset[k]) * got.load[k].moment - i.torque) /
                            (scale * arms * i.radius));
          worse(moment, norm((0.5 - s.bonds.arm_offset[k]) * got.load[k].moment - j.torque) /
                            (scale * arms * j.radius));
        }
        worse(history,
              norm(Vec3{s.bonds.shear_x[k], s.bonds.shear_y[k], s.bonds.shear_z[k]} - b.F_s) / scale);
        if (features.plasticity) worse(history, std::abs(s.bonds.plastic_stretch[k] - b.u_p) / b.d0);
        if (features.breakage)
          worse(history, std::max(std::abs(s.bonds.damage_normal[k] - b.D_n),
                                  std::abs(s.bonds.damage_shear[k] - b.D_s)));
      }
      for (std::size_t k = 0; k < s.particles.size; ++k)
        s.particles.position[k] += s.dt * s.particles.velocity[k];
    }
    for (const ref::Bond& b : s.reference) newly_broken += b.broken != ref::Broken::no;
    INFO(name_of(set), ", rotation ", features.rotation, ", plasticity ", features.plasticity, ", breakage ",
         features.breakage, ", criterion ", int(kernel.criterion));
    // the plastic part of a slip is a quotient of differences of lengths (B107), good to 1e-16
    // d/du
    const double allowed = follows && features.plasticity ? 1e-10 : 1e-11;
    CHECK(force < allowed);
    CHECK(moment < allowed);
    CHECK(history < allowed);
    if (features.breakage) CHECK(newly_broken + broken > 10);
  };
  for (const Kernel& kernel : kernels())
    for (const InstructionSet set : scene::sets_of_this_machine())
      for (const bool follows : {false, true}) hold(kernel, set, follows);
}

TEST_CASE(
    "bond pass: swapping the two ends of the input changes no bit of force, torque and history [STYLE 9, "
    "equal]") {
  for (const Kernel& kernel : kernels())
    for (const InstructionSet set : scene::sets_of_this_machine()) {
      const Features& features = kernel.features;
      Bundle a = random_bundle(kernel, 21), b = random_bundle(kernel, 21);
      swap_ends(b);
      const Loads f = pass(a, features, set), g = pass(b, features, set);
      std::size_t different = 0;
      for (std::size_t k = 0; k < a.bonds.size; ++k)
        different += !(f.load[k].force == -g.load[k].force) ||
                     (features.rotation && !(f.load[k].moment == g.load[k].moment)) ||
                     !same_history(a.bonds, k, b.bonds, k, -1);
      INFO(name_of(set), ", rotation ", features.rotation, ", criterion ", int(kernel.criterion));
      CHECK(different == 0);
    }
}

TEST_CASE("bond pass: a bond's result does not depend on its place and neighbours in the batch [equal]") {
  for (const Kernel& kernel : kernels())
    for (const InstructionSet set : scene::sets_of_this_machine()) {
      const Features& features = kernel.features;
      Bundle a = random_bundle(kernel, 33), b = a;
      std::vector<std::size_t> from(a.bonds.size);
      std::iota(from.begin(), from.end(), std::size_t{0});
      std::shuffle(from.begin(), from.end(), std::mt19937_64(3));
      const BondTable source = a.bonds;
      b.bonds.for_each_column([&](const ColumnInfo& info, auto& column) {
        source.for_each_column([&](const ColumnInfo& other, const auto& values) {
          if constexpr (std::is_same_v<std::decay_t<decltype(values)>, std::decay_t<decltype(column)>>)
            if (info.name == other.name && !column.empty())
              for (std::size_t k = 0; k < from.size(); ++k) column[k] = values[from[k]];
        });
      });
      const Loads f = pass(a, features, set), g = pass(b, features, set);
      std::size_t different = 0;
      for (std::size_t k = 0; k < from.size(); ++k)
        different += !(g.load[k].force == f.load[from[k]].force) ||
                     (features.rotation && !(g.load[k].moment == f.load[from[k]].moment)) ||
                     !same_history(b.bonds, k, a.bonds, from[k], 1);
      INFO(name_of(set), ", criterion ", int(kernel.criterion));
      CHECK(different == 0);
    }
}

TEST_CASE("bond pass: a scene runs its nearest superset, with the same spins") {
  for_each_law([]<class Law>(const Law& law) {
    for (const Features& built : Law::feature_sets) {
      INFO(Law::name);
      CHECK(built_features(law, built) == built);
    }
  });
  const BondLaw dempack = DempackLaw{}, kdem = KdemLaw{};
  const Features elastic{.plasticity = false, .breakage = false};
  CHECK(built_features(dempack, {.contact_damping = false, .plasticity = false, .breakage = false}) ==
        elastic);
  CHECK(built_features(dempack, {.rotation = false, .plasticity = false, .breakage = false}) == elastic);
  CHECK(built_features(dempack, {.rotation = false, .breakage = false}) == Features{.rotation = false});
  CHECK(built_features(dempack, {.criterion = Criterion::mohr_coulomb}) == Features{});
  CHECK(built_features(dempack, {.rotation = false, .criterion = Criterion::coupled}) ==
        Features{.criterion = Criterion::coupled});
  CHECK(built_features(kdem, elastic) == Features{.plasticity = false});
  CHECK_THROWS(built_features(kdem, {.plasticity = false, .criterion = Criterion::coupled}));
  CHECK_THROWS(built_features(kdem, {}));  // the law has no plasticity to run
  CHECK_THROWS(bond_pass_for(dempack, {.contact_damping = false}, InstructionSet::x86_64));
}

TEST_CASE("bond pass: what a scene leaves out does not happen in the superset that runs it [exact]") {
  for (const Features asked : {Features{.rotation = false, .plasticity = false, .breakage = false},
                               Features{.rotation = false, .breakage = false}, Features{.breakage = false},
                               Features{.rotation = false, .plasticity = false}}) {
    const World w = scene::crushed(asked);
    const BrokenCount broken = count_broken(w);
    CHECK((broken.tension + broken.shear > 0) == asked.breakage);
    const auto& plastic = w.bonds.plastic_stretch;
    CHECK(std::any_of(plastic.begin(), plastic.end(), [](double u) { return u < 0.0; }) == asked.plasticity);
    CHECK(std::ranges::any_of(w.particles.spin, [](const Vec3& s) { return norm(s) > 0; }) == asked.rotation);
    CHECK(std::isfinite(stored_energy(w)));
  }
}

TEST_CASE("bond pass: file order and a reversal of all ids change no bit of a run [STYLE 9, equal]") {
  const Specimen specimen = scene::small_packing(150);
  const auto run = [&](const Specimen& s, ScatterKind scatter, int threads) {
    ref::Parameters p;
    p.alpha = 0.8;
    const Features features{};
    const Assembly a = assemble(s, scene::small_cylinder(), {}, features, 1);
    WorldOptions o = scene::options(p);
    o.scatter = scatter, o.threads = threads;
    World w = make_world(a, scene::material_of(p), scene::factor(p), o);
    for (int k = 0; k < 150; ++k) {
      scene::drive(w, 6, -6);
      advance(w);
    }
    CHECK(count_broken(w).tension > 0);
    return w;
  };
  Specimen shuffled = specimen, reversed = specimen;
  std::shuffle(shuffled.spheres.begin(), shuffled.spheres.end(), std::mt19937_64(9));
  for (auto& s : reversed.spheres) s.id = 151 - s.id;
  for (const ScatterKind scatter : {ScatterKind::private_sums, ScatterKind::gather})
    for (const int threads : {1, 2}) {
      const World a = run(specimen, scatter, threads), b = run(shuffled, scatter, threads);
      CHECK(state_hash(a.particles, a.bonds) == state_hash(b.particles, b.bonds));
      if (scatter == ScatterKind::gather) continue;  // sums in the order of ids
      const World c = run(reversed, scatter, threads);
      CHECK(c.particles.position == a.particles.position);
      CHECK(c.particles.velocity == a.particles.velocity);
      CHECK(c.particles.spin == a.particles.spin);
      CHECK(c.bonds.damage_normal == a.bonds.damage_normal);
    }
}
