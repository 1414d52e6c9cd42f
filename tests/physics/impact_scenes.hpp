// One or two particles and a wall, as the tests of impacts need them.
#pragma once
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "core/impact/impact.hpp"

namespace scene {

using namespace breccia;

inline ImpactResult run(const ImpactScene& s) {
  ImpactResult r;
  run_impact(s, r);
  return r;
}

inline ImpactMaterial rigid(ImpactMaterial m) {
  m.young_modulus *= 1e10;
  return m;
}

inline ImpactWall plane(std::size_t material) {
  return {Wall{WallKind::plane, {}, {0, 0, 1}, 0, {}, {}}, material};
}

/// A sphere that touches a rigid plane z = 0 and is about to press it.
inline ImpactScene sphere_on_plane(const ImpactMaterial& m, double radius, const Vec3& velocity,
                                   const Vec3& spin = {}) {
  ImpactScene s;
  s.materials = {m, rigid(m)};
  s.particles = {{{0, 0, radius}, velocity, spin, radius, 0}};
  s.walls = {plane(1)};
  s.duration = 6.0 * radius * std::pow(m.density / m.young_modulus, 0.4) *
               std::pow(std::abs(velocity.z), -0.2) *
               (m.restitution < 0.3 ? 3.0 : 1.0);  // of a Hertz contact 2 to 3 times as long
  return s;
}

/// Two equal spheres along x that touch and approach each other with `speed` each.
inline ImpactScene head_on(const ImpactMaterial& m, double radius, double speed) {
  ImpactScene s;
  s.materials = {m};
  s.particles = {{{-radius, 0, 0}, {speed, 0, 0}, {}, radius, 0},
                 {{radius, 0, 0}, {-speed, 0, 0}, {}, radius, 0}};
  s.duration = 6.0 * radius * std::pow(m.density / m.young_modulus, 0.4) * std::pow(speed, -0.2);
  return s;
}

struct Point {
  double x, y;
};

/// The points of a digitised curve; none where the folder of reference results is absent.
inline std::vector<Point> digitised(const std::string& name, const std::string& series = "") {
  std::ifstream in(std::filesystem::path(BRECCIA_SOURCE_DIR "/../shared/reference") / name);
  std::vector<Point> points;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with('#')) continue;
    if (!series.empty()) {
      if (!line.starts_with('"' + series)) continue;
      line.erase(0, line.find("\",") + 2);
    }
    std::istringstream fields(line);
    Point p;
    char comma;
    if (fields >> p.x >> comma >> p.y) points.push_back(p);
  }
  return points;
}

}  // namespace scene
