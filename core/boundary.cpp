#include "core/boundary.hpp"

#include <Eigen/Cholesky>

#include <cmath>
#include <numbers>

namespace breccia {

Platens make_platens(const Assembly& a, const ParticleTable& particles, bool rough, double young_modulus) {
  Platens p;
  p.rough = rough;
  p.section = a.section();
  double specimen_mass = 0.0;
  for (std::size_t row = 0; row < particles.size; ++row) {
    specimen_mass += particles.mass[row];
    if (row >= particles.free) p.mass[row >= a.first_top] += particles.mass[row];
  }
  // the axial wave impedance of the specimen: critical for half its mass on half its stiffness, and a wave
  // that reaches the platen is swallowed instead of sent back
  p.dashpot = p.section * std::sqrt(young_modulus * specimen_mass / a.volume());
  return p;
}

void drive_platens(Platens& platens, const ParticleTable& particles, std::size_t first_top, double dt) {
  std::array<double, 2> force{};
  for (std::size_t row = particles.free; row < first_top; ++row) force[0] += particles.force[row].z;
  for (std::size_t row = first_top; row < particles.size; ++row) force[1] += particles.force[row].z;
  platens.stress = {-force[0] / platens.section, force[1] / platens.section};
  if (platens.servo)
    for (const int end : {0, 1}) {
      const double inward = end == 0 ? 1.0 : -1.0;
      const double speed = inward * platens.velocity[static_cast<std::size_t>(end)];
      const auto k = static_cast<std::size_t>(end);
      const double push = (platens.pressure - platens.stress[k]) * platens.section;
      // dashpot taken at the end of the step, so that no layer is too light for it
      const double next =
          (speed + dt * push / platens.mass[k]) / (1.0 + dt * platens.dashpot / platens.mass[k]);
      platens.velocity[k] = inward * next;
    }
  platens.travel[0] += dt * platens.velocity[0];
  platens.travel[1] -= dt * platens.velocity[1];
}

Confinement make_confinement(const Assembly& a) {
  Confinement c;
  c.rows = a.skin;
  double sum = 0.0;
  for (const Row row : c.rows) {
    const double r = a.particles.radius[row];
    c.weight.push_back(std::numbers::pi * r * r);
    sum += c.weight.back();
  }
  for (double& w : c.weight) w *= a.mantle() / sum;
  c.force.resize(c.rows.size());
  return c;
}

void press_skin(Confinement& c, ParticleTable& particles) {
  if (c.pressure == 0.0) return;
  // radial forces leave a net force and moments about x and y: the smallest horizontal correction a + b z + c
  // (-y, x) that removes them and makes no moment about z
  double n = 0.0, x1 = 0.0, y1 = 0.0, z1 = 0.0, z2 = 0.0, xz = 0.0, yz = 0.0, r2 = 0.0;
  Vec3 net, tilt;
  for (std::size_t k = 0; k < c.rows.size(); ++k) {
    const Vec3& x = particles.position[c.rows[k]];
    const double radial = x.x * x.x + x.y * x.y;
    const double inward = -c.pressure * c.weight[k] / std::sqrt(radial);
    c.force[k] = {inward * x.x, inward * x.y, 0.0};
    net += c.force[k];
    tilt += x.z * c.force[k];
    n += 1.0, x1 += x.x, y1 += x.y, z1 += x.z, z2 += x.z * x.z, xz += x.x * x.z, yz += x.y * x.z,
        r2 += radial;
  }
  Eigen::Matrix<double, 5, 5> gram;
  // clang-format off
  gram <<   n, 0.0,  z1, 0.0, -y1,
          0.0,   n, 0.0,  z1,  x1,
           z1, 0.0,  z2, 0.0, -yz,
          0.0,  z1, 0.0,  z2,  xz,
          -y1,  x1, -yz,  xz,  r2;
  // clang-format on
  const Eigen::Vector<double, 5> left{net.x, net.y, tilt.x, tilt.y, 0.0};
  const Eigen::Vector<double, 5> by = gram.ldlt().solve(left);
  for (std::size_t k = 0; k < c.rows.size(); ++k) {
    const Vec3& x = particles.position[c.rows[k]];
    c.force[k] -= Vec3{by[0] + by[2] * x.z - by[4] * x.y, by[1] + by[3] * x.z + by[4] * x.x, 0.0};
    particles.force[c.rows[k]] += c.force[k];
  }
}

}  // namespace breccia
