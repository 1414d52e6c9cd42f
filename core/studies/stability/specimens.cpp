#include "core/studies/stability/specimens.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <random>

#include "core/packing/packing.hpp"

namespace breccia {
namespace {

Gid next_id(const Specimen& s) {
  Gid id = 0;
  for (const SpecimenSphere& one : s.spheres) id = std::max(id, one.id);
  return id + 1;
}

/// A unit vector across another.
Vec3 across(const Vec3& n) {
  const Vec3 other = std::abs(n.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 c = cross(n, other);
  return (1.0 / norm(c)) * c;
}

}  // namespace

const Specimen& stability_packing(std::size_t spheres) {
  static std::map<std::size_t, Specimen> made;
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  const auto [at, is_new] = made.try_emplace(spheres);
  if (is_new) {
    PackRequest request;
    request.spheres = spheres;
    at->second = pack_spheres(stability_body, request);
  }
  return at->second;
}

void add_dust(Specimen& s, double ratio, std::size_t count) {
  double mean = 0.0;
  for (const SpecimenSphere& one : s.spheres) mean += one.radius / static_cast<double>(s.spheres.size());
  const double small = mean / ratio, reach = 0.95 * small;  // a little overlap with both
  const std::size_t hosts = s.spheres.size();
  Gid id = next_id(s);
  std::size_t added = 0;
  const auto is_free = [&](const Vec3& x, std::size_t i, std::size_t j) {
    for (std::size_t k = 0; k < s.spheres.size(); ++k)
      if (k != i && k != j && norm(s.spheres[k].centre - x) < s.spheres[k].radius + small) return false;
    return true;
  };
  for (std::size_t i = 0; i < hosts; ++i)
    for (std::size_t j = i + 1; j < hosts && added < count; ++j) {
      const SpecimenSphere a = s.spheres[i], b = s.spheres[j];
      const Vec3 l = b.centre - a.centre;
      const double d = norm(l), from_a = a.radius + reach, from_b = b.radius + reach;
      if (d > a.radius + b.radius) continue;
      const double along = (d * d + from_a * from_a - from_b * from_b) / (2.0 * d);
      if (!(from_a * from_a > along * along)) continue;
      const double aside = std::sqrt(from_a * from_a - along * along);
      const Vec3 n = (1.0 / d) * l, first = across(n), second = cross(n, first);
      for (const auto& [c, e] : {std::pair{1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}}) {
        const Vec3 x = a.centre + along * n + aside * (c * first + e * second);
        if (!is_free(x, i, j)) continue;
        s.spheres.push_back({.id = id++, .centre = x, .radius = small});
        ++added;
        break;
      }
    }
}

void add_nested(Specimen& s, double distance, std::size_t count) {
  Gid id = next_id(s);
  for (std::size_t k = 0; k < count; ++k) {
    const SpecimenSphere host = s.spheres[k];
    s.spheres.push_back({.id = id++,
                         .centre = host.centre + (distance * host.radius) * Vec3{0.6, 0.0, 0.8},
                         .radius = 0.5 * host.radius});
  }
}

Specimen stack_of(std::size_t count, const Body& body) {
  Specimen s;
  s.source = "stack";
  const double r = 0.5 * body.height / static_cast<double>(count);
  for (std::size_t k = 0; k < count; ++k)
    s.spheres.push_back({.id = k + 1,
                         .centre = {0.0, 0.0, (2.0 * static_cast<double>(k) + 1.0) * r - 0.5 * body.height},
                         .radius = r});
  return s;
}

void soften_lower_half(World& w, double factor) {
  BondTable& b = w.bonds;
  const auto is_low = [&](Row row) { return w.particles.position[row].z < 0.0; };
  for (std::size_t k = 0; k < b.size; ++k) {
    const int low = is_low(b.row_lo[k]) + is_low(b.row_hi[k]);
    const double by = low == 0 ? 1.0 : low == 2 ? factor : 2.0 * factor / (1.0 + factor);
    b.stiffness[k] *= by;
    b.area[k] *= by;
    if (!b.strength_area.empty()) b.strength_area[k] *= by;
  }
}

void spread_masses(World& w, double decades) {
  std::vector<std::size_t> order(w.particles.size);
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::mt19937_64 random(1);
  for (std::size_t k = order.size() - 1; k > 0; --k) std::swap(order[k], order[random() % (k + 1)]);
  for (std::size_t k = 0; k < order.size(); ++k)
    w.particles.mass[order[k]] *=
        std::pow(10.0, decades * (static_cast<double>(k) / static_cast<double>(order.size() - 1) - 0.5));
}

}  // namespace breccia
