#include "tests/reference/reference.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <tuple>

namespace breccia::reference {
namespace {

constexpr double pi = std::numbers::pi;

Vec3 normalized(const Vec3& a) { return (1.0 / norm(a)) * a; }

// "|F| := length" of section 4
Vec3 with_length(const Vec3& a, double length) { return norm(a) > 0 ? (length / norm(a)) * a : Vec3{}; }

// (P46): what is left of the secant stiffness
double g(double D, double delta) { return (1 - D) / (1 + delta * D); }

// Damage on a linear softening branch that starts at ratio 1 and ends at 1 + delta.
double softening(double ratio, double delta) {
  if (delta > 0) return std::clamp((ratio - 1) / delta, 0.0, 1.0);
  return ratio > 1 ? 1.0 : 0.0;
}

double kappa(const Parameters& p) { return p.kappa ? *p.kappa : 1 / (2 * (1 + p.nu)); }  // (P36)

double contact_area(const Parameters& p, const Particle& i, const Particle& j) {  // (P21)
  const double r_c = std::min(i.radius, j.radius);
  return p.alpha * pi * r_c * r_c;
}

double critical_damping(const Parameters& p, const Particle& i, const Particle& j, double k_n) {
  const double m_ij = i.mass * j.mass / (i.mass + j.mass);  // (P28)
  // (S3.8)
  return 2 * p.xi * std::sqrt(m_ij * k_n);
}

Pair ordered(const std::vector<Particle>& particles, std::size_t i, std::size_t j) {
  return particles[i].id < particles[j].id ? Pair{i, j} : Pair{j, i};
}

std::vector<Pair> all_pairs(const std::vector<Particle>& particles) {
  std::vector<std::size_t> rows(particles.size());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = i;
  std::ranges::sort(rows, {}, [&](std::size_t i) { return particles[i].id; });
  std::vector<Pair> pairs;
  for (std::size_t a = 0; a < rows.size(); ++a)
    for (std::size_t b = a + 1; b < rows.size(); ++b) pairs.emplace_back(rows[a], rows[b]);
  return pairs;
}

// --- Kinematics of a pair, section 4
// ------------------------------------------------------------------------------

struct Kinematics {
  double d;         // distance
  Vec3 n, n0;       // unit vector i to j, now and one step ago
  double a_i, a_j;  // arms, their sum is d
  double v_n;       // opening velocity
  Vec3 du;          // tangential displacement in this step
  double twist;     // mean rotation of the pair about n in this step
};

Kinematics kinematics(const Particle& i, const Particle& j, double dt) {
  Kinematics k{};
  const Vec3 l = j.x - i.x;
  const Vec3 v = j.v - i.v;
  k.d = norm(l);
  k.n = normalized(l);
  k.n0 = normalized(l - dt * v);  // (B4)
  // (B3)
  k.a_i = k.d * i.radius / (i.radius + j.radius);
  k.a_j = k.d - k.a_i;
  k.v_n = dot(v, k.n);
  const Vec3 v_r = v - cross(k.a_i * i.w + k.a_j * j.w, k.n);
  k.du = dt * (v_r - dot(v_r, k.n) * k.n);  // (P34)
  k.twist = 0.5 * dt * dot(i.w + j.w, k.n);
  return k;
}

// A tangential vector of one step ago follows the pair: the smallest rotation that takes n0 to n,
// then the twist.
Vec3 carry(const Vec3& F, const Kinematics& k) {
  const Vec3 tilted = F - (dot(F, k.n) / (1 + dot(k.n0, k.n))) * (k.n0 + k.n);  // (B5)
  return std::cos(k.twist) * tilted + std::sin(k.twist) * cross(k.n, tilted);
}

void apply(const Kinematics& k, double normal, const Vec3& shear, Particle& i, Particle& j) {
  const Vec3 on_i = normal * k.n + shear;
  i.force += on_i;
  // (P3) (P18)
  j.force -= on_i;
  i.torque += k.a_i * cross(k.n, shear);  // (P4)
  j.torque += k.a_j * cross(k.n, shear);
}

// --- Section 3: compression
// ---------------------------------------------------------------------------------------

// Stress on the envelope at total compressive strain e; E is the bond's own k_n d0/A.
double envelope(const Parameters& p, const Bond& b, double e) {
  const double E = b.k_n * b.strain_length / b.area;
  const double e1 = p.LCS[0] / E;
  const double e2 = e1 + (p.LCS[1] - p.LCS[0]) * p.YRC[0] / E;
  const double e3 = e2 + (p.LCS[2] - p.LCS[1]) * p.YRC[1] / E;
  if (e <= e1) return E * e;  // (B17) (P53)
  if (e <= e2) return p.LCS[0] + E / p.YRC[0] * (e - e1);
  if (e <= e3) return p.LCS[1] + E / p.YRC[1] * (e - e2);
  return p.LCS[2] + E / p.YRC[2] * (e - e3);
}

// (P52): a trial above the envelope is put on it, the plastic stretch takes the rest.
void yield(const Parameters& p, Bond& b, double u) {
  const double e = -u / b.strain_length;
  const double s = -b.k_n * (b.u_p < 0 ? p.unloads : 1.0) * (u - b.u_p) / b.area;
  if (e * b.k_n * b.strain_length / b.area <= p.LCS[0])
    return;  // elastic branch: nothing but round-off to take
  const double limit = envelope(p, b, e);
  if (s > limit && limit >= p.yield_stress) b.u_p = u + limit * b.area / (p.unloads * b.k_n);  // (B118)
}

// (B118): the stretch at which k_n would carry what the bond carries.
double carried(const Parameters& p, const Bond& b, double u, double u_p) {
  if (!p.plasticity || u - u_p >= 0) return u - u_p;
  if (u_p < 0) return p.unloads * (u - u_p);
  if (p.yield_stress > p.LCS[0] && -b.k_n * u / b.area > p.LCS[0])
    return -envelope(p, b, -u / b.strain_length) * b.area / b.k_n;
  return u;
}

// (B107): the part of the slip that is plastic. It is that of the stretch, but gains no more work
// than the pressure loses.
double plastic_slip(const Parameters& p, const Bond& b, double flow, double longer, double u_e, double u_e0,
                    const Vec3& F, const Vec3& du) {
  if (!p.shear_follows || flow <= 0 || norm(du) == 0) return 0;
  double part = std::min(1.0, flow / std::abs(longer));
  const double gain = -dot(F, du);
  if (gain > 0) part = std::clamp(-b.k_n * 0.5 * (u_e + u_e0) * flow / gain, 0.0, part);
  return part;
}

void fail(Bond& b, Broken mode) {
  b.broken = mode;
  (mode == Broken::tension ? b.D_n : b.D_s) = 1;
}

// --- Sections 3 and 4: an intact bond
// -----------------------------------------------------------------------------

// Tension on its own (P49): the normal force.
double tension(const Parameters& p, Bond& b, double u_e) {
  const double u_l = p.sigma_t * b.area / b.k_n;
  if (p.breakage) b.D_n = std::max(b.D_n, softening(u_e / u_l, b.delta_n));  // (P41) (P49)
  if (b.D_n >= 1) fail(b, Broken::tension);
  return b.k_n * u_e * g(b.D_n, b.delta_n);  // (P46)
}

// Shear on its own. F_s is the undamaged trial k_s u, so u/u_l is |F_s|/S. Returns the force that
// acts.
Vec3 shear(const Parameters& p, Bond& b, double F_n) {
  const double N = std::max(-F_n, 0.0);
  const double R = p.mu2 * N;  // (P45)
  const double S = p.criterion == Criterion::mohr_coulomb ? std::max(0.0, p.tau_f * b.area - p.mu1 * F_n)
                                                          : p.tau_f * b.area + p.mu1 * N;  // (P42)
  const double trial = g(b.D_s, b.delta_s) * norm(b.F_s);
  if (p.breakage && norm(b.F_s) > S * (1 + b.delta_s * b.D_s)) {
    const double D = std::max(b.D_s, softening(norm(b.F_s) / S, b.delta_s));
    if (D >= 1 || (1 - D) * S <= R) {  // (B21)
      fail(b, Broken::shear);
      b.F_s = with_length(b.F_s, std::min(trial, R));
      return b.F_s;
    }
    b.D_s = D;
    return with_length(b.F_s, (1 - D) * S);
  }
  return g(b.D_s, b.delta_s) * b.F_s;
}

// The coupled criterion for an open bond: one damage for both forces. a and b are the shares of
// tension and shear. F_s is the undamaged k_s u, so opening alone changes the mixture of the deltas
// but never the shear displacement.
void coupled_tension(const Parameters& p, Bond& bond, double u_e) {
  const double a = bond.k_n * u_e / (p.sigma_t * bond.area);
  const double b = norm(bond.F_s) / (p.tau_f * bond.area);
  const double r = a + b;
  const double delta = (bond.delta_n * a + bond.delta_s * b) / r;  // (B24)
  const double D = p.breakage ? std::max(bond.D_n, softening(r, delta)) : bond.D_n;
  if (D >= 1) {
    fail(bond, a >= b ? Broken::tension : Broken::shear);
    return;
  }
  bond.D_n = bond.D_s = D;
  bond.normal_force = g(D, delta) * bond.k_n * u_e;
  bond.shear_force = g(D, delta) * bond.F_s;
}

void intact_bond(const Parameters& p, Bond& b, double u_e) {
  if (p.criterion == Criterion::coupled && u_e > 0) return coupled_tension(p, b, u_e);
  b.normal_force = u_e > 0 ? tension(p, b, u_e) : b.k_n * u_e;  // a closed crack has the full k_n
  if (b.broken != Broken::no) return;
  b.shear_force = shear(p, b, b.normal_force);
  if (p.criterion == Criterion::coupled && b.broken == Broken::no) b.D_n = b.D_s;
}

// --- Section 4: friction after failure
// ----------------------------------------------------------------------------

void broken_bond(const Parameters& p, Bond& b, double u_e) {
  b.normal_force = std::min(b.k_n * u_e, 0.0);  // (B22)
  const double R = p.mu2 * -b.normal_force;
  if (norm(b.F_s) > R) b.F_s = with_length(b.F_s, R);  // (P45)
  b.shear_force = b.F_s;
}

// --- Section 6: unbonded pairs, linear
// ----------------------------------------------------------------------------

void update_contact(const Parameters& p, Contact& c, Particle& i, Particle& j, double dt) {
  const Kinematics k = kinematics(i, j, dt);
  const double u = k.d - c.free_length;
  const double k_n = p.E * contact_area(p, i, j) / (i.radius + j.radius);  // (B30)
  const double k_s = kappa(p) * k_n;
  c.normal_force = std::min(k_n * u, 0.0);
  c.normal_total = c.normal_force;
  if (p.contact_damping && u < 0)  // never pulls
    c.normal_total = std::min(c.normal_force + critical_damping(p, i, j, k_n) * k.v_n, 0.0);
  const double R = p.mu2 * -c.normal_force;
  c.F_s = carry(c.F_s, k) + k_s * k.du;
  if (norm(c.F_s) > R) c.F_s = with_length(c.F_s, R);  // (S3.17)
  apply(k, c.normal_total, c.F_s, i, j);
}

// --- Section 7: global damping
// ------------------------------------------------------------------------------------

Vec3 damped(const Vec3& F, const Vec3& v, double factor) {  // (P39) (P40)
  return norm(v) > 0 ? F - (factor * norm(F) / norm(v)) * v : F;
}

Vec3 without_held(const Vec3& a, const std::array<bool, 3>& held) {
  return {held[0] ? 0.0 : a.x, held[1] ? 0.0 : a.y, held[2] ? 0.0 : a.z};
}

}  // namespace

// --- Sections 1 and 2
// ---------------------------------------------------------------------------------------------

Particle sphere(const Parameters& p, std::int64_t id, double radius, Vec3 x, int group) {
  Particle s;
  s.id = id;
  s.radius = radius;
  s.mass = p.density * 4.0 / 3.0 * pi * radius * radius * radius;  // (B1)
  // (B2)
  s.inertia = 0.4 * s.mass * radius * radius;
  s.group = group;
  s.x = x;
  return s;
}

Bond make_bond(const Parameters& p, const std::vector<Particle>& particles, std::size_t row_a,
               std::size_t row_b) {
  Bond b;
  std::tie(b.i, b.j) = ordered(particles, row_a, row_b);
  const Particle& i = particles[b.i];
  const Particle& j = particles[b.j];
  b.d0 = norm(j.x - i.x);                                         // (P26)
  b.strain_length = std::max(b.d0, 0.2 * (i.radius + j.radius));  // nested spheres (B8)
  b.area = contact_area(p, i, j);
  b.k_n = p.E * b.area / b.strain_length;  // (P30)
  // (P36)
  b.k_s = kappa(p) * b.k_n;
  b.c_n = critical_damping(p, i, j, b.k_n);
  // (B18)
  b.delta_n = p.G_I ? std::max(0.0, 2 * b.k_n * *p.G_I / (p.sigma_t * p.sigma_t * b.area) - 1) : p.delta_n;
  b.delta_s = p.G_II ? std::max(0.0, 2 * b.k_s * *p.G_II / (p.tau_f * p.tau_f * b.area) - 1) : p.delta_s;
  return b;
}

void make_bonds(World& world) {
  const Parameters& p = world.parameters;
  for (const Pair& pair : all_pairs(world.particles)) {
    const Particle& i = world.particles[pair.first];
    const Particle& j = world.particles[pair.second];
    const double d = norm(j.x - i.x);
    const double touch = i.radius + j.radius;
    if (i.group != 0 && i.group == j.group && d <= (1 + p.beta) * touch)  // (P16), upper bound only
      world.bonds.push_back(make_bond(p, world.particles, pair.first, pair.second));
    else if (d < touch)
      world.contacts[pair].free_length = d;  // (B31)
  }
}

// --- Sections 3 and 4
// ---------------------------------------------------------------------------------------------

void bond_law(const Parameters& p, Bond& b, double u, double longer, const Vec3& turned, const Vec3& du) {
  const double before = b.u_p;
  if (p.plasticity) yield(p, b, u);
  const double u_e = carried(p, b, u, b.u_p), u_e0 = carried(p, b, u - longer, before);
  b.F_s =
      turned + (1 - plastic_slip(p, b, before - b.u_p, longer, u_e, u_e0, turned, du)) * b.k_s * du;  // (B20)
  if (b.broken == Broken::no) intact_bond(p, b, u_e);
  if (b.broken != Broken::no) broken_bond(p, b, u_e);  // also in the very step of failure
}

void update_bond(const Parameters& p, Bond& b, Particle& i, Particle& j, double dt) {
  const Kinematics k = kinematics(i, j, dt);
  const double u = k.d - b.d0;
  bond_law(p, b, u, dt * k.v_n, carry(b.F_s, k), k.du);

  b.normal_total = b.normal_force;
  if (p.contact_damping && b.broken == Broken::no) {
    const double u_e = u - b.u_p;
    const double left = u_e > 0 ? b.normal_force / (b.k_n * u_e) : 1.0;  // g(D_n) in tension
    // (P29)
    b.normal_total += left * b.c_n * k.v_n;
  } else if (p.contact_damping && b.normal_force < 0) {
    b.normal_total = std::min(b.normal_force + b.c_n * k.v_n, 0.0);  // never pulls (B12)
  }
  apply(k, b.normal_total, b.shear_force, i, j);
}

void compute_forces(World& world, double dt) {
  const Parameters& p = world.parameters;
  for (Particle& a : world.particles) {
    a.force = a.external_force;
    a.torque = a.external_torque;
  }
  std::set<Pair> bonded;
  for (Bond& b : world.bonds) {
    bonded.emplace(b.i, b.j);
    update_bond(p, b, world.particles[b.i], world.particles[b.j], dt);
  }
  if (!p.unbonded_contacts) return;
  for (const Pair& pair : all_pairs(world.particles)) {
    if (bonded.contains(pair)) continue;  // a broken bond is its pair's contact
    Particle& i = world.particles[pair.first];
    Particle& j = world.particles[pair.second];
    const double touch = i.radius + j.radius;
    if (norm(j.x - i.x) >= touch) {
      world.contacts.erase(pair);  // parted: history and initial overlap are forgotten
      continue;
    }
    const auto [contact, is_new] = world.contacts.try_emplace(pair);
    if (is_new) contact->second.free_length = touch;
    update_contact(p, contact->second, i, j, dt);
  }
}

// --- Sections 1 and 7: central differences (P5-P10)
// ---------------------------------------------------------------

void step(World& world, double dt) {
  const Parameters& p = world.parameters;
  compute_forces(world, dt);
  for (Particle& a : world.particles) {
    const Vec3 F = without_held(a.force, a.held);  // held components neither move nor are damped
    // (P1) (P6)
    a.v += (dt / a.mass) * damped(F, without_held(a.v, a.held), p.damping_translation);
    a.x += dt * a.v;  // (P7)
    // (P2) (P9)
    if (p.rotation) a.w += (dt / a.inertia) * damped(a.torque, a.w, p.damping_rotation);
  }
}

// --- One bond along a path
// ----------------------------------------------------------------------------------------

std::vector<Bond> bond_path(const Parameters& p, Bond b, std::span<const PathPoint> path) {
  std::vector<Bond> history;
  PathPoint last;
  for (const PathPoint& point : path) {
    bond_law(p, b, point.u, point.u - last.u, b.F_s, {0, point.y - last.y, point.z - last.z});
    history.push_back(b);
    last = point;
  }
  return history;
}

void place_pair(const Bond& b, const PathPoint& from, const PathPoint& to, double dt, Particle& i,
                Particle& j) {
  const double d = b.d0 + to.u;
  i.x = i.v = {};
  j.x = {d, 0, 0};
  j.v = {(to.u - from.u) / dt, 0, 0};
  const Vec3 du{0, to.y - from.y, to.z - from.z};
  i.w = j.w =
      (-1 / (d * dt)) * cross(Vec3{1, 0, 0}, du);  // rolling of both: moves the surfaces, does not turn n
}

}  // namespace breccia::reference
