// Another code's bond in shear, as its own regression file has it, up to where that code goes
// wrong.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

#include "core/stepping/step.hpp"
#include "core/world/energies.hpp"
#include "tests/scene.hpp"

using namespace breccia;

namespace {

/// The lower sphere at rest, the upper led around it on a circle at 20 pi 1/s without
/// spinning, so that the bond is sheared and neither stretched nor pressed.
struct Pair24 {
  World w;
  double angle = 0;

  Pair24() {
    reference::Parameters p;
    p.mu1 = 1;
    p.delta_s = 1;
    w = scene::kratos_pair(p, 1e-7);
  }
  Vec3 place() const { return {2 * std::sin(angle), 0, -1 + 2 * std::cos(angle)}; }
  void step() {
    const Vec3 here = place();
    angle += 20 * std::numbers::pi * w.dt;
    w.platens.velocity[1] = (1 / w.dt) * (place() - here);
    w.particles.velocity[1] = w.platens.velocity[1];
    advance(w);
  }
};

}  // namespace

TEST_CASE(
    "kratos: two spheres in shear, to the peak, softening, Coulomb [Kratos DEM benchmark 24, 1e-4 of the "
    "strength]") {
  const std::filesystem::path file =
      std::filesystem::path(BRECCIA_SOURCE_DIR "/../shared/reference") / "reference_graph_benchmark24.dat";
  if (!std::filesystem::exists(file)) {
    MESSAGE("skipped 'reference_graph_benchmark24.dat is not here'");
    return;
  }
  std::vector<double> times, theirs;
  std::ifstream in(file);
  for (double time = 0, x = 0, y = 0; in >> time >> x >> y;)
    times.push_back(time), theirs.push_back(std::hypot(x, y));
  REQUIRE(theirs.size() > 500);

  Pair24 pair;
  std::vector<double> ours;
  for (std::size_t k = 0; k < theirs.size(); ++k) {
    pair.step();
    ours.push_back(norm(pair.w.platens.force[1]));
  }
  const double strength = 0.5e6 * std::numbers::pi;
  const auto peak = std::size_t(std::max_element(ours.begin(), ours.end()) - ours.begin());
  CHECK(ours[peak] == doctest::Approx(strength).epsilon(1e-4));
  CHECK(times[peak] == doctest::Approx(1.91e-5).epsilon(1e-3));  // tau_f A/(k_s v) = 1.9098e-5 s
  double rising = 0, falling = 0;
  for (std::size_t k = 0; k < peak; ++k) rising = std::max(rising, std::abs(ours[k] - theirs[k]) / strength);
  // that code takes its damage from the next displacement: its falling branch is ours, one step
  // early
  for (std::size_t k = peak; times[k] < 3.8e-5; ++k)
    falling = std::max(falling, std::abs(ours[k + 1] - theirs[k]) / strength);
  CHECK(rising < 1e-4);
  CHECK(falling < 1e-4);
  // nothing presses the broken bond: no friction, where that code keeps 115.7 N
  CHECK(ours.back() < 1e-9 * strength);  // round-off of the circle may press it by an ulp
  CHECK(count_broken(pair.w).shear == 1);
}
