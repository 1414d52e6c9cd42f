#include "core/boundary/platens_and_confinement.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/bonding/lateral_area.hpp"

namespace breccia {

namespace {

struct LayerForces {
  std::array<Vec3, 2> force{};
  LayerForces& operator+=(const LayerForces& o) {
    force[0] += o.force[0], force[1] += o.force[1];
    return *this;
  }
};

std::array<Vec3, 2> forces_on_layers(const ParticleTable& p, const Partition& partition,
                                     std::size_t first_top) {
  std::vector<LayerForces> blocks;
  const auto held = [&](std::size_t row) { return std::max(row, p.free); };
  const auto force_on = [&](std::size_t row) {
    LayerForces f;
    f.force[row >= first_top] = p.force[row];
    return f;
  };
  return sum_blocks(partition, 1, blocks, held, each<LayerForces>(force_on)).force;
}

}  // namespace

Platens make_platens(const Assembly& a, const ParticleTable& particles, bool rough, double young_modulus) {
  Platens p;
  p.rough = rough;
  p.section = a.load_section();
  double specimen_mass = 0.0;
  for (std::size_t row = 0; row < particles.size; ++row) {
    specimen_mass += particles.mass[row];
    if (row >= particles.free) p.mass[row >= a.first_top] += particles.mass[row];
  }
  // the axial wave impedance of the specimen: critical for half its mass on half its stiffness, and
  // a wave that reaches the platen is swallowed instead of sent back
  p.dashpot = a.section() * std::sqrt(young_modulus * specimen_mass / a.volume());  // (B66)
  if (a.grip == Support::halves) {
    // a lid must give way quickly where the band below it dilates. Its layer's motion is
    // prescribed, so that its mass is the servo's to choose: of three specimens at 0.1 m/s and 1 to
    // 4 MPa these parts hold the normal stress to 7, 4 and 1 % (root mean square to the peak)
    // instead of 15, 11 and 2 %; a thirtieth of the mass is too light for the bonds that pull on it
    p.servo_part = 0.3;
    p.dashpot *= 0.5;
  }
  return p;
}

void drive_platens(Platens& platens, const ParticleTable& particles, const Partition& partition,
                   std::size_t first_top, const std::array<double, 2>& behind, double dt) {
  platens.force = forces_on_layers(particles, partition, first_top);
  for (const std::size_t k : {0u, 1u}) platens.force[k].z -= behind[k];
  for (const std::size_t k : {0u, 1u}) {
    Vec3& velocity = platens.velocity[k];
    if (platens.servo) {
      const double inward = k == 0 ? 1.0 : -1.0;
      // (B66)
      const double push = platens.pressure * platens.section + inward * platens.force[k].z;
      // dashpot taken at the end of the step, so that no layer is too light for it
      const double mass = platens.servo_part * platens.mass[k];
      velocity.z = inward * (inward * velocity.z + dt * push / mass) / (1.0 + dt * platens.dashpot / mass);
    }
    platens.travel[k] += dt * velocity;
    platens.work -= dt * dot(platens.force[k], velocity);
  }
}

namespace {

/// Of a box each of the four faces has its nominal surface, shared by the spheres that touch it as
/// pi r^2. (B121)
void set_face_weights(Confinement& c, const Assembly& a) {
  const auto weights = [&](double Vec3::*normal, double width, double surface) {
    std::vector<double> weight(c.rows.size());
    for (const double side : {-1.0, 1.0}) {
      double sum = 0.0;
      std::vector<std::size_t> touching;
      for (std::size_t k = 0; k < c.rows.size(); ++k) {
        const double r = a.particles.radius[c.rows[k]], reach = r + 0.3 * a.mean_radius;
        if (side * (a.particles.position[c.rows[k]].*normal) + reach <= 0.5 * width) continue;
        touching.push_back(k);
        sum += std::numbers::pi * r * r;
      }
      for (const std::size_t k : touching) {
        const double r = a.particles.radius[c.rows[k]];
        weight[k] += side * std::numbers::pi * r * r * surface / sum;
      }
    }
    return weight;
  };
  const Body& body = a.body;
  c.weight_x = weights(&Vec3::x, body.diameter, body.depth * body.height);
  c.weight = weights(&Vec3::y, body.depth, body.diameter * body.height);
  c.surface_y = 2.0 * body.diameter * body.height;
}

}  // namespace

Confinement make_confinement(const Assembly& a, SkinWeights weights, bool rigid) {
  Confinement c;
  c.rigid = rigid;
  c.plane = a.space == Space::two_d;
  c.prism = a.body.shape == Shape::box && !c.plane && !rigid;
  c.rows = a.lateral;
  c.surface = a.lateral_surface();
  c.height = a.length();
  c.force.resize(c.rows.size());
  c.drifts.assign(c.rows.size(), 0);
  if (weights == SkinWeights::voronoi) {
    c.weight = lateral_areas(a.particles, c.rows, a.body, a.space);
    return c;
  }
  if (c.prism) {
    set_face_weights(c, a);
    return c;
  }
  for (const Row row : c.rows) {
    const double r = a.particles.radius[row];
    c.weight.push_back(c.plane ? 2.0 * r : std::numbers::pi * r * r);  // (B71)
  }
  // each side of a rectangle, or the whole lateral surface, has its nominal surface
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

double lateral_cover(const Assembly& a) {
  double sum = 0.0;
  for (const Row row : a.lateral) {
    const double r = a.particles.radius[row];
    sum += a.space == Space::two_d ? 2.0 * r * a.body.depth : std::numbers::pi * r * r;
  }
  return sum / a.lateral_surface();
}

bool is_one_sphere_wide(const Assembly& a) {
  const auto& x = a.particles.reference_position;
  const double width = 1e-6 * a.body.diameter;
  return std::all_of(a.lateral.begin(), a.lateral.end(), [&](Row row) {
    return std::abs(x[row].x) < width && (a.space == Space::two_d || std::abs(x[row].y) < width);
  });
}

namespace {

/// Two dimensions: pressure along x on both sides; the smallest a + b z along x removes the net
/// force and the moment about y. (B72)
struct SideSums {
  double n = 0, z1 = 0, z2 = 0, net = 0, tilt = 0;
  double inward = 0, side = 0, side_z = 0;  // side: 1 for each on the left, -1 on the right
  SideSums& operator+=(const SideSums& o) {
    n += o.n, z1 += o.z1, z2 += o.z2, net += o.net, tilt += o.tilt;
    inward += o.inward, side += o.side, side_z += o.side_z;
    return *this;
  }
};

void press_sides(Confinement& c, ParticleTable& particles, const Partition& partition) {
  std::vector<SideSums> blocks;
  const SideSums s = sum_listed(partition, c.rows, 1, blocks, [&](std::size_t k) {
    const Vec3& x = particles.position[c.rows[k]];
    const double side = x.x < 0.0 ? 1.0 : -1.0, push = c.pressure * c.grown * c.weight[k];
    c.force[k] = {side * push, 0.0, 0.0};
    return SideSums{1.0, x.z, x.z * x.z, c.force[k].x, x.z * c.force[k].x, push, side, side * x.z};
  });
  const double det = s.n * s.z2 - s.z1 * s.z1;
  const double a = (s.net * s.z2 - s.tilt * s.z1) / det, b = (s.n * s.tilt - s.z1 * s.net) / det;
  c.acting = (s.inward - a * s.side - b * s.side_z) / (c.grown * c.surface);
  for_owned_entries(partition, c.rows, [&](std::size_t k) {
    c.force[k].x -= a + b * particles.position[c.rows[k]].z;
    particles.force[c.rows[k]] += c.force[k];
  });
}

/// Of forces along one direction on the pair of faces normal to it: the smallest a + b u + c z
/// along it, u the other lateral direction, removes the net force and both moments. (B121)
struct FaceSums {
  double n = 0, u1 = 0, z1 = 0, u2 = 0, z2 = 0, uz = 0, net = 0, turn = 0, tilt = 0;
  double inward = 0, side = 0, side_u = 0, side_z = 0;
  FaceSums& operator+=(const FaceSums& o) {
    n += o.n, u1 += o.u1, z1 += o.z1, u2 += o.u2, z2 += o.z2, uz += o.uz;
    net += o.net, turn += o.turn, tilt += o.tilt;
    inward += o.inward, side += o.side, side_u += o.side_u, side_z += o.side_z;
    return *this;
  }
};

/// A sphere that has been squeezed out past the other pair of faces by more than its radius has
/// left the face: pressed on, it would be shot along that other face.
bool has_left(const ParticleTable& p, Row row, double Vec3::*across) {
  return std::abs(p.position[row].*across) > std::abs(p.reference_position[row].*across) + p.radius[row];
}

/// @param weight  m^2, of each row, positive on the face at the positive end
/// @returns N, the inward force on both faces
double press_pair_of_faces(Confinement& c, ParticleTable& particles, const Partition& partition,
                           double pressure, std::span<const double> weight, double Vec3::*normal,
                           double Vec3::*across) {
  const auto is_pressed = [&](std::size_t k) {
    return weight[k] != 0.0 && !has_left(particles, c.rows[k], across);
  };
  // nothing that holds together moves faster than a step of the pressure would make it, p/sqrt(E
  // rho)
  const double fast = c.impedance > 0.0 ? 2.0 * pressure / c.impedance : 0.0;
  const auto push = [&](std::size_t k) {
    const double full = -pressure * c.grown * weight[k], speed = particles.velocity[c.rows[k]].*normal;
    const double inward = full < 0.0 ? -speed : speed;
    return fast > 0.0 ? full * std::clamp(2.0 - inward / fast, 0.0, 1.0) : full;
  };
  std::vector<FaceSums> blocks;
  const FaceSums s = sum_listed(partition, c.rows, 1, blocks, [&](std::size_t k) {
    if (!is_pressed(k)) return FaceSums{};
    const Vec3& x = particles.position[c.rows[k]];
    const double u = x.*across, f = push(k), side = weight[k] > 0.0 ? -1.0 : 1.0;
    return FaceSums{1.0,   u,       x.z,      u * u, x.z * x.z, u * x.z,   f,
                    u * f, x.z * f, side * f, side,  side * u,  side * x.z};
  });
  Eigen::Matrix3d gram;
  gram << s.n, s.u1, s.z1, s.u1, s.u2, s.uz, s.z1, s.uz, s.z2;
  const Eigen::Vector3d by = gram.ldlt().solve(Eigen::Vector3d{s.net, s.turn, s.tilt});
  for_owned_entries(partition, c.rows, [&](std::size_t k) {
    if (!is_pressed(k)) return;
    const Vec3& x = particles.position[c.rows[k]];
    const double f = push(k) - by[0] - by[1] * (x.*across) - by[2] * x.z;
    c.force[k].*normal += f;
    particles.force[c.rows[k]].*normal += f;
  });
  return s.inward - by[0] * s.side - by[1] * s.side_u - by[2] * s.side_z;
}

void press_faces(Confinement& c, ParticleTable& particles, const Partition& partition) {
  for_owned_entries(partition, c.rows, [&](std::size_t k) { c.force[k] = {}; });
  press_pair_of_faces(c, particles, partition, c.pressure_x, c.weight_x, &Vec3::x, &Vec3::y);
  const double on_y = press_pair_of_faces(c, particles, partition, c.pressure, c.weight, &Vec3::y, &Vec3::x);
  c.acting = on_y / (c.grown * c.surface_y);
}

/// Of places, and of the radial forces that the pressure makes.
struct SkinSums {
  double n = 0, x1 = 0, y1 = 0, z1 = 0, z2 = 0, xz = 0, yz = 0, r2 = 0;
  double net_x = 0, net_y = 0, tilt_x = 0, tilt_y = 0;
  double inward = 0, out_x = 0, out_y = 0, out_xz = 0, out_yz = 0;  // out: unit vectors away from the axis
  SkinSums& operator+=(const SkinSums& o) {
    n += o.n, x1 += o.x1, y1 += o.y1, z1 += o.z1, z2 += o.z2, xz += o.xz, yz += o.yz, r2 += o.r2;
    net_x += o.net_x, net_y += o.net_y, tilt_x += o.tilt_x, tilt_y += o.tilt_y;
    inward += o.inward, out_x += o.out_x, out_y += o.out_y, out_xz += o.out_xz, out_yz += o.out_yz;
    return *this;
  }
};

}  // namespace

namespace {

struct Widening {
  double now = 0, before = 0;
  Widening& operator+=(const Widening& o) {
    now += o.now, before += o.before;
    return *this;
  }
};

}  // namespace

void measure_surface(Confinement& c, const ParticleTable& p, const Partition& partition,
                     const Platens& platens) {
  std::vector<Widening> blocks;
  const Widening wide = sum_listed(partition, c.rows, 1, blocks, [&](std::size_t k) {
    const Vec3 &x = p.position[c.rows[k]], &x0 = p.reference_position[c.rows[k]];
    return Widening{x.x * x0.x + x.y * x0.y, x0.x * x0.x + x0.y * x0.y};
  });
  const double height = 1.0 - approach(platens) / c.height;
  c.grown = height * (c.plane || !(wide.before > 0.0) ? 1.0 : wide.now / wide.before);  // (B115)
}

void apply_confinement(Confinement& c, ParticleTable& particles, const Partition& partition) {
  if (c.rigid) return;
  c.acting = 0.0;
  if (c.pressure == 0.0) return;
  if (c.plane) return press_sides(c, particles, partition);
  if (c.prism) return press_faces(c, particles, partition);
  // (B72): radial forces leave a net force and moments about x and y: the smallest horizontal
  // correction a + b z + c (-y, x) that removes them and makes no moment about z
  std::vector<SkinSums> blocks;
  const SkinSums s = sum_listed(partition, c.rows, 1, blocks, [&](std::size_t k) {
    const Vec3& x = particles.position[c.rows[k]];
    const double radial = x.x * x.x + x.y * x.y;
    const double push = radial > 0.0 ? c.pressure * c.grown * c.weight[k] : 0.0;
    const double away = radial > 0.0 ? std::sqrt(radial) : 1.0, inward = -push / away;
    const Vec3& f = c.force[k] = {inward * x.x, inward * x.y, 0.0};
    const double out_x = x.x / away, out_y = x.y / away;
    return SkinSums{1.0, x.x,       x.y,       x.z,  x.z * x.z, x.x * x.z, x.y * x.z,   radial,     f.x,
                    f.y, x.z * f.x, x.z * f.y, push, out_x,     out_y,     out_x * x.z, out_y * x.z};
  });
  Eigen::Matrix<double, 5, 5> gram;
  // clang-format off
  gram <<   s.n,   0.0,  s.z1,   0.0, -s.y1,
            0.0,   s.n,   0.0,  s.z1,  s.x1,
           s.z1,   0.0,  s.z2,   0.0, -s.yz,
            0.0,  s.z1,   0.0,  s.z2,  s.xz,
          -s.y1,  s.x1, -s.yz,  s.xz,  s.r2;
  // clang-format on
  const Eigen::Vector<double, 5> left{s.net_x, s.net_y, s.tilt_x, s.tilt_y, 0.0};
  const Eigen::Vector<double, 5> by = gram.ldlt().solve(left);
  c.acting = (s.inward + by[0] * s.out_x + by[1] * s.out_y + by[2] * s.out_xz + by[3] * s.out_yz) /
             (c.grown * c.surface);
  for_owned_entries(partition, c.rows, [&](std::size_t k) {
    const Vec3& x = particles.position[c.rows[k]];
    c.force[k] -= Vec3{by[0] + by[2] * x.z - by[4] * x.y, by[1] + by[3] * x.z + by[4] * x.x, 0.0};
    particles.force[c.rows[k]] += c.force[k];
  });
}

void restrain_laterally(Confinement& c, ParticleTable& particles, const Partition& partition) {
  if (!c.rigid) return;
  std::vector<double> blocks;
  const double outward = sum_listed(partition, c.rows, 1, blocks, [&](std::size_t k) {
    const Vec3& x = particles.position[c.rows[k]];
    Vec3& force = particles.force[c.rows[k]];
    const double away = std::hypot(x.x, x.y);
    const double part = away > 0.0 ? (x.x * force.x + x.y * force.y) / away : 0.0;
    c.force[k] = {-force.x, -force.y, 0.0};
    force.x = force.y = 0.0;
    return part;
  });
  c.pressure = c.acting = outward / c.surface;  // (B73)
}

}  // namespace breccia
