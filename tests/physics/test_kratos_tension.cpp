// Another code's bond in tension, as its own regression file has it.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

#include "core/stepping/step.hpp"
#include "core/world/energies.hpp"
#include "tests/scene.hpp"

using namespace breccia;

TEST_CASE(
    "kratos: two spheres pulled apart, softening to failure [Kratos DEM benchmark 22, 1e-5 of the "
    "strength]") {
  const std::filesystem::path file =
      std::filesystem::path(BRECCIA_SOURCE_DIR "/../shared/reference") / "reference_graph_benchmark22.dat";
  if (!std::filesystem::exists(file)) {
    MESSAGE("skipped 'reference_graph_benchmark22.dat is not here'");
    return;
  }
  reference::Parameters p;
  p.delta_n = 0.8;
  World w = scene::kratos_pair(p, 1e-5);
  scene::drive(w, 0, 0.1);
  w.particles.velocity[1].z = 0.1;
  std::ifstream in(file);
  double time = 0, along = 0, across = 0, worst = 0, peak = 0, peak_time = 0;
  int rows = 0;
  while (in >> time >> along >> across) {
    advance(w);
    const double force = w.platens.force[1].z;  // on the moving sphere: back towards the other
    worst = std::max(worst, std::abs(force - along) / 3.14159e6);
    if (-force > peak) peak = -force, peak_time = time;
    ++rows;
  }
  CHECK(rows == 5000);
  CHECK(worst < 1e-5);
  CHECK(peak == doctest::Approx(3.14159e6).epsilon(1e-5));
  CHECK(peak_time == doctest::Approx(0.02).epsilon(1e-3));
  CHECK(count_broken(w).tension == 1);
}
