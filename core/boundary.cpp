#include "core/boundary.hpp"

#include <Eigen/Cholesky>

#include <cmath>
#include <numbers>

#include "core/mantle_area.hpp"

namespace breccia {

Platens make_platens(const Assembly& a, const ParticleTable& particles, bool rough, double young_modulus) {
  Platens p;
  p.rough = rough;
  p.section = a.load_section();
  double specimen_mass = 0.0;
  for (std::size_t row = 0; row < particles.size; ++row) {
    specimen_mass += particles.mass[row];
    if (row >= particles.free) p.mass[row >= a.first_top] += particles.mass[row];
  }
  // the axial wave impedance of the specimen: critical for half its mass on half its stiffness, and a wave
  // that reaches the platen is swallowed instead of sent back
  p.dashpot = a.section() * std::sqrt(young_modulus * specimen_mass / a.volume());
  return p;
}

void drive_platens(Platens& platens, const ParticleTable& particles, std::size_t first_top, double dt) {
  platens.force = {};
  for (std::size_t row = particles.free; row < first_top; ++row) platens.force[0] += particles.force[row];
  for (std::size_t row = first_top; row < particles.size; ++row) platens.force[1] += particles.force[row];
  for (const std::size_t k : {0u, 1u}) {
    Vec3& velocity = platens.velocity[k];
    if (platens.servo) {
      const double inward = k == 0 ? 1.0 : -1.0;
      const double push = platens.pressure * platens.section + inward * platens.force[k].z;
      // dashpot taken at the end of the step, so that no layer is too light for it
      velocity.z = inward * (inward * velocity.z + dt * push / platens.mass[k]) /
                   (1.0 + dt * platens.dashpot / platens.mass[k]);
    }
    platens.travel[k] += dt * velocity;
    platens.work -= dt * dot(platens.force[k], velocity);
  }
}

Confinement make_confinement(const Assembly& a, SkinWeights weights, bool rigid) {
  Confinement c;
  c.rigid = rigid;
  c.plane = a.space == Space::plane;
  c.rows = a.skin;
  c.surface = a.mantle();
  c.force.resize(c.rows.size());
  if (weights == SkinWeights::voronoi) {
    c.weight = mantle_areas(a.particles, c.rows, a.body, a.space);
    return c;
  }
  for (const Row row : c.rows) {
    const double r = a.particles.radius[row];
    c.weight.push_back(c.plane ? 2.0 * r : std::numbers::pi * r * r);
  }
  // each side of a rectangle, or the whole mantle, has its nominal surface
  const auto scale = [&](auto belongs, double surface) {
    double sum = 0.0;
    for (std::size_t k = 0; k < c.rows.size(); ++k)
      if (belongs(a.particles.position[c.rows[k]])) sum += c.weight[k];
    for (std::size_t k = 0; k < c.rows.size(); ++k)
      if (belongs(a.particles.position[c.rows[k]])) c.weight[k] *= surface / sum;
  };
  if (!c.plane) {
    scale([](const Vec3&) { return true; }, c.surface);
  } else {
    scale([](const Vec3& x) { return x.x < 0.0; }, 0.5 * c.surface);
    scale([](const Vec3& x) { return !(x.x < 0.0); }, 0.5 * c.surface);
  }
  return c;
}

namespace {

/// Two dimensions: pressure along x on both sides; the smallest a + b z along x removes the net force and the
/// moment about y.
void press_sides(Confinement& c, ParticleTable& particles) {
  double n = 0.0, z1 = 0.0, z2 = 0.0, net = 0.0, tilt = 0.0;
  for (std::size_t k = 0; k < c.rows.size(); ++k) {
    const Vec3& x = particles.position[c.rows[k]];
    c.force[k] = {(x.x < 0.0 ? 1.0 : -1.0) * c.pressure * c.weight[k], 0.0, 0.0};
    net += c.force[k].x, tilt += x.z * c.force[k].x;
    n += 1.0, z1 += x.z, z2 += x.z * x.z;
  }
  const double det = n * z2 - z1 * z1;
  const double a = (net * z2 - tilt * z1) / det, b = (n * tilt - z1 * net) / det;
  for (std::size_t k = 0; k < c.rows.size(); ++k) {
    c.force[k].x -= a + b * particles.position[c.rows[k]].z;
    particles.force[c.rows[k]] += c.force[k];
  }
}

}  // namespace

void press_skin(Confinement& c, ParticleTable& particles) {
  if (c.rigid || c.pressure == 0.0) return;
  if (c.plane) return press_sides(c, particles);
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

void hold_skin(Confinement& c, ParticleTable& particles) {
  if (!c.rigid) return;
  double outward = 0.0;
  for (std::size_t k = 0; k < c.rows.size(); ++k) {
    const Vec3& x = particles.position[c.rows[k]];
    Vec3& force = particles.force[c.rows[k]];
    outward += (x.x * force.x + x.y * force.y) / std::hypot(x.x, x.y);
    c.force[k] = {-force.x, -force.y, 0.0};
    force.x = force.y = 0.0;
  }
  c.pressure = outward / c.surface;
}

}  // namespace breccia
