// Contacts between surfaces that were never bonded: found before they can overlap, kept while they
// last, and never made of what is bonded.
#include <doctest/doctest.h>

#include <map>
#include <random>

#include "core/stepping/step.hpp"
#include "core/world/energies.hpp"
#include "core/world/energy_accounting.hpp"
#include "core/world/make_world.hpp"
#include "kernels/laws/hertz_mindlin.hpp"
#include "tests/scene.hpp"

using namespace breccia;
namespace ref = breccia::reference;
using scene::Ball;

namespace {

using Ends = std::pair<Row, Row>;

std::set<Ends> candidates(const World& w) {
  std::set<Ends> all;
  for (std::size_t k = 0; k < w.contacts.size; ++k)
    all.insert(std::minmax(w.contacts.row_lo[k], w.contacts.row_hi[k]));
  return all;
}
std::set<Ends> bonded(const World& w) {
  std::set<Ends> all;
  for (std::size_t k = 0; k < w.bonds.size; ++k)
    all.insert(std::minmax(w.bonds.row_lo[k], w.bonds.row_hi[k]));
  return all;
}
std::set<Ends> overlapping(const World& w, const std::vector<Vec3>& x) {
  std::set<Ends> all;
  for (Row i = 0; i < x.size(); ++i)
    for (Row j = i + 1; j < x.size(); ++j)
      if (norm(x[j] - x[i]) < w.particles.radius[i] + w.particles.radius[j]) all.insert({i, j});
  return all;
}

World world_of(const std::vector<Ball>& balls, const ref::Parameters& p) {
  return make_world(scene::free_body(balls, p.beta, scene::options(p).features), scene::material_of(p),
                    scene::factor(p), scene::options(p));
}

struct Witness {
  int missed = 0, met = 0, bonded_contacts = 0;
};

/// Advances and compares what overlaps when forces are computed with what is on the list then.
Witness watch(World& w, int steps) {
  Witness seen;
  const std::set<Ends> bonds = bonded(w);
  for (int k = 0; k < steps; ++k) {
    const std::vector<Vec3> x(w.particles.position.begin(), w.particles.position.end());
    advance(w);
    const std::set<Ends> list = candidates(w);
    for (const Ends& pair : overlapping(w, x)) {
      if (bonds.contains(pair)) continue;
      ++seen.met;
      seen.missed += !list.contains(pair);
    }
    for (const Ends& pair : list) seen.bonded_contacts += bonds.contains(pair);
  }
  return seen;
}

/// Two spheres bonded far away: a world needs a bond.
void add_bonded_pair(std::vector<Ball>& balls) {
  const Gid id = balls.size() + 1;
  balls.push_back({id, 0.01, {5, 5, 5}, 99});
  balls.push_back({id + 1, 0.01, {5.02, 5, 5}, 99});
}

ref::Parameters soft() {
  ref::Parameters p;
  p.E = 1e7;
  return p;
}

}  // namespace

TEST_CASE(
    "contacts: a gas of 80 unequal spheres: every overlap is on the list when its force is due [all steps]") {
  const ref::Parameters p = soft();
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> in(-1, 1), unit(0, 1);
  std::vector<Ball> balls;
  while (balls.size() < 80) {
    const Ball b{balls.size() + 1, 0.01 + 0.03 * unit(random),
                 0.25 * Vec3{in(random), in(random), in(random)}, 0,
                 5.0 * Vec3{in(random), in(random), in(random)}};
    if (std::ranges::all_of(balls, [&](const Ball& o) { return norm(o.x - b.x) > o.radius + b.radius; }))
      balls.push_back(b);
  }
  for (Ball& b : balls) b.v -= 8.0 * b.x;
  add_bonded_pair(balls);
  World w = world_of(balls, p);
  w.dt *= 0.2;
  w.neighbour_list.check_every = 40;  // too seldom for the fastest: the search has to see that
  const Witness seen = watch(w, 4000);
  CHECK(seen.met > 500);
  CHECK(seen.missed == 0);
  CHECK(w.neighbour_list.rebuilds > 3);
  CHECK(w.neighbour_list.rebuilds < 2000);
}

TEST_CASE(
    "contacts: spheres apart by more than the skin that are pressed together evenly are found in time [all "
    "steps]") {
  const ref::Parameters p = soft();
  std::vector<Ball> balls;
  for (int k = 0; k < 22; ++k) {
    const double z = 0.022 * (k - 10.5);  // gaps of 2 mm; the skin is 0.2 mean radii, some 2 mm
    balls.push_back({Gid(k + 1), 0.0098, {0, 0, z}, 0, {0, 0, -0.2 * z}});
  }
  balls.push_back({23, 0.002, {0, 0.5, 0}, 99});  // the only near pair at the start
  balls.push_back({24, 0.002, {0, 0.504, 0}, 99});
  World w = world_of(balls, p);
  REQUIRE(0.022 - 2 * 0.0098 > w.neighbour_list.skin);
  const Witness seen = watch(w, int(0.9 / w.dt));
  CHECK(seen.met > 100);
  CHECK(seen.missed == 0);
}

TEST_CASE(
    "contacts: a specimen crushed between platens: nothing is missed, bonded pairs never become contacts "
    "[all steps]") {
  ref::Parameters p;
  p.alpha = 0.8;
  const Assembly a = assemble(scene::small_packing(120), scene::small_cylinder(), {}, Features{}, 1);
  World w = make_world(a, scene::material_of(p), scene::factor(p), scene::options(p));
  scene::drive(w, 12, -12);
  const Witness seen = watch(w, 800);
  CHECK(count_broken(w).tension + count_broken(w).shear > 20);
  CHECK(seen.met > 100);
  CHECK(seen.missed == 0);
  CHECK(seen.bonded_contacts == 0);
}

TEST_CASE(
    "contacts: pairs that overlap unbonded lie still, and are ordinary contacts once parted [(B31), rel "
    "1e-12]") {
  ref::Parameters p;
  p.contact_damping = false;
  p.xi = 0;
  std::vector<Ball> balls{
      {1, 0.01, {0, 0, 0}, 0}, {2, 0.01, {0.017, 0, 0}, 0}, {3, 0.01, {0.017, 0.012, 0}, 1}};
  add_bonded_pair(balls);
  World w = world_of(balls, p);
  for (int k = 0; k < 300; ++k) advance(w);
  for (std::size_t k = 0; k < w.particles.size; ++k) CHECK(w.particles.velocity[k] == Vec3{});
  CHECK(w.contacts.size == 3);

  const double k_n = p.E * std::numbers::pi * 1e-4 / 0.02;
  const auto force_at = [&](double x) {  // on the first sphere along x, the others out of the way
    w.particles.position[0] = {0, -1, 0};
    w.particles.position[1] = {x, -1, 0};
    w.particles.position[2] = {0, 1, 0};
    std::fill(w.particles.velocity.begin(), w.particles.velocity.end(), Vec3{});
    advance(w);
    return w.particles.velocity[0].x * w.particles.mass[0] / w.dt;
  };
  CHECK(force_at(0.0165) ==
        doctest::Approx(-k_n * 0.0005).epsilon(1e-9));  // pressed from the initial distance
  CHECK(force_at(0.0180) == 0.0);                       // opened, not yet parted
  CHECK(force_at(0.0165) == doctest::Approx(-k_n * 0.0005).epsilon(1e-9));
  CHECK(force_at(0.0201) == 0.0);  // parted
  CHECK(force_at(0.0195) == doctest::Approx(-k_n * 0.0005).epsilon(1e-9));
}

TEST_CASE("contacts: a new list keeps the friction and free length of pairs in contact [equal bits]") {
  const ref::Parameters p = soft();
  std::vector<Ball> balls{{1, 0.01, {0, 0, 0}, 0, {}, {0, 0, 20}},
                          {2, 0.01, {0.0202, 0, 0}, 0, {-0.2, 0, 0}},
                          {3, 0.012, {0, 0.0222, 0}, 0, {0, -0.2, 0}},
                          {4, 0.01, {0.05, 0, 0}, 0}};
  add_bonded_pair(balls);
  World w = world_of(balls, p);
  const auto rubbing = [&] {
    return std::ranges::count_if(w.contacts.shear_force, [](const Vec3& f) { return norm(f) > 0; });
  };
  for (int k = 0; k < 40 && rubbing() < 2; ++k) advance(w);
  REQUIRE(rubbing() == 2);
  std::map<std::pair<Gid, Gid>, std::pair<double, Vec3>> before;
  for (std::size_t k = 0; k < w.contacts.size; ++k) {
    before[{w.contacts.gid_lo[k], w.contacts.gid_hi[k]}] = {w.contacts.free_length[k],
                                                            w.contacts.shear_force[k]};
  }
  w.particles.position[3] = {0.0305, 0, 0};  // a new neighbour, so that rows shift
  rebuild_neighbour_list(
      w.neighbour_list, w.contacts, w.particles,
      {w.contact_young, w.contact_poisson, w.shear_ratio, 1, w.alpha, Space::three_d, contact_columns(w)}, 1);
  CHECK(w.contacts.size > before.size());
  std::size_t kept = 0;
  for (std::size_t k = 0; k < w.contacts.size; ++k) {
    const auto old = before.find({w.contacts.gid_lo[k], w.contacts.gid_hi[k]});
    if (old == before.end()) {
      CHECK(w.contacts.shear_force[k] == Vec3{});
      CHECK(w.contacts.free_length[k] ==
            w.particles.radius[w.contacts.row_lo[k]] + w.particles.radius[w.contacts.row_hi[k]]);
      continue;
    }
    ++kept;
    CHECK(w.contacts.free_length[k] == old->second.first);
    CHECK(w.contacts.shear_force[k] == old->second.second);
  }
  CHECK(kept == before.size());
}

TEST_CASE("contacts: switched off, nothing is ever searched for [exact]") {
  ref::Parameters p = soft();
  p.unbonded_contacts = false;
  std::vector<Ball> balls{{1, 0.01, {0, 0, 0}, 0, {1, 0, 0}}, {2, 0.01, {0.025, 0, 0}, 0}};
  add_bonded_pair(balls);
  World w = world_of(balls, p);
  for (int k = 0; k < 400; ++k) advance(w);
  CHECK(w.neighbour_list.rebuilds == 0);
  CHECK(w.particles.velocity[0] == Vec3{1, 0, 0});
}

TEST_CASE("contacts: lists every N steps, and refused where spheres may have met in between [exact]") {
  reference::Parameters p;
  WorldOptions o = scene::options(p);
  const auto world = [&](int every, double speed) {
    o.search_every = every;
    World w = make_world(scene::free_body({{1, 0.01, {0, 0, 0}, 0, {speed, 0, 0}},
                                           {2, 0.01, {0.03, 0, 0}, 0},
                                           {3, 0.01, {0.2, 0, 0}},
                                           {4, 0.01, {0.22, 0, 0}}},
                                          p.beta, o.features),
                         scene::material_of(p), scene::factor(p), o);
    w.dt = 1e-6;
    return w;
  };
  // 10 mm apart: they meet in either run, and part with the same speeds
  World by_skin = world(0, 20), every_ten = world(10, 20);
  for (int step = 0; step < 1000; ++step) advance(by_skin), advance(every_ten);
  CHECK(every_ten.neighbour_list.rebuilds == 100);
  CHECK(by_skin.neighbour_list.rebuilds < 50);
  CHECK(by_skin.particles.velocity[1].x > 1);
  for (std::size_t k = 0; k < 4; ++k)
    CHECK(norm(by_skin.particles.velocity[k] - every_ten.particles.velocity[k]) < 1e-9);
  World too_long = world(700, 20);
  const auto run = [&] {
    for (int step = 0; step < 700; ++step) advance(too_long);
  };
  CHECK_THROWS_WITH_AS(run(), doctest::Contains("run.search_every = 700 is too long"), SimulationBroke);
}

namespace {

/// Two spheres that meet, and a bonded pair far away; Hertz's contacts, no damping.
World two_that_meet(const Vec3& velocity, double friction, const Vec3& spin = {}) {
  ref::Parameters p;
  p.xi = p.damping_translation = p.damping_rotation = 0;
  std::vector<Ball> balls{{1, 0.01, {0, 0, 0}, 0, 0.5 * velocity, spin},
                          {2, 0.006, {0.0161, 0, 0}, 0, -0.5 * velocity, -spin}};
  add_bonded_pair(balls);
  Material m = scene::material_of(p);
  m.contact_law = ContactLaw::hertz_mindlin;
  m.friction_dynamic = friction;
  WorldOptions o = scene::options(p);
  o.ledger = true;
  const Features columns = built_features(scene::law(p), o.features, {Precision::full, true});
  World w = make_world(scene::free_body(balls, p.beta, columns), m, scene::factor(p), o);
  w.dt = 2e-8;
  return w;
}

}  // namespace

TEST_CASE("contacts: Hertz's impact between two spheres of a bonded scene [closed form, 1e-3]") {
  World w = two_that_meet({3, 0, 0}, 0);
  const ParticleTable& p = w.particles;
  const ElasticBody a{w.material.young_modulus, w.material.poisson_ratio, 1 / 0.01, 1 / p.mass[0]};
  ElasticBody b = a;
  b.curvature = 1 / 0.006;
  const HertzMindlin law = hertz_mindlin(a, b, 0, 0);
  const double reduced = p.mass[0] * p.mass[1] / (p.mass[0] + p.mass[1]);
  const HertzImpact wanted = hertz_impact(law.normal, reduced, 3);
  double most = 0, force = 0;
  std::uint64_t first = 0, last = 0;
  for (int k = 0; k < 10000; ++k) {
    const double overlap = 0.016 - norm(p.position[1] - p.position[0]);
    if (overlap > 0) first = first ? first : w.step, last = w.step;
    const Vec3 before = p.velocity[0];
    advance(w);
    most = std::max(most, overlap);
    force = std::max(force, norm(p.velocity[0] - before) * p.mass[0] / w.dt);
  }
  REQUIRE(last > first);
  CHECK(w.contacts.hertz_normal[0] == doctest::Approx(law.normal).epsilon(1e-12));
  CHECK(w.contacts.hertz_tangential[0] == doctest::Approx(law.tangential).epsilon(1e-12));
  CHECK(most == doctest::Approx(wanted.overlap).epsilon(1e-3));
  CHECK(force == doctest::Approx(wanted.force).epsilon(1e-3));
  CHECK(double(last - first + 1) * w.dt == doctest::Approx(wanted.duration).epsilon(2e-3));
  CHECK(norm(p.velocity[1] - p.velocity[0]) == doctest::Approx(3).epsilon(1e-4));
}

TEST_CASE("contacts: an oblique impact of Hertz and Mindlin only loses energy, and it is booked [1e-4]") {
  for (const double friction : {0.0, 0.2, 5.0}) {
    World w = two_that_meet({2, 2, 0}, friction, {0, 0, 40});
    double dissipated = 0;
    for (int k = 0; k < 12000; ++k) {
      advance(w);
      if (k % 50 != 0) continue;
      const EnergyBalance e = energy_balance(w);
      CHECK(e.dissipated() >= dissipated - 1e-9 * e.work);
      CHECK(std::abs(e.imbalance()) < 1e-4 * e.work);
      dissipated = e.dissipated();
    }
    CHECK(w.contacts.size > 0);
    const EnergyBalance e = energy_balance(w);
    CHECK(std::abs(e.stored) < 1e-9 * e.work);  // they have parted
    CHECK((e.friction > 1e-3 * e.work) == (friction > 0));
  }
}

TEST_CASE("contacts: the step counts Hertz's with what it has at a tenth of the smaller radius [1e-12]") {
  World w = two_that_meet({3, 0, 0}, 0.3);
  while (w.contacts.size == 0) advance(w);
  const double root = std::sqrt(0.1 * 0.006);
  const ContactTable& c = w.contacts;
  CHECK(c.stiffness[0] ==
        doctest::Approx(std::max(1.5 * c.hertz_normal[0], c.hertz_tangential[0] / w.shear_ratio[0]) * root)
            .epsilon(1e-12));
}
