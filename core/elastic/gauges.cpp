#include "core/elastic/gauges.hpp"

#include <algorithm>
#include <cmath>

namespace breccia {

namespace {

/// What hangs on nothing tells nothing about the strain of the specimen.
bool is_loose(const Assembly& a, std::size_t row) { return !a.loose.empty() && a.loose[row] != 0; }

}  // namespace

namespace {

bool is_left_out(const Assembly& a, Row row, std::span<const Gid> left_out) {
  return is_loose(a, row) ||
         std::find(left_out.begin(), left_out.end(), a.particles.gid[row]) != left_out.end();
}

}  // namespace

Gauge axial_gauge(const Assembly& a, std::span<const Gid> left_out) {
  Gauge g;
  const auto& x = a.particles.reference_position;
  double mean = 0.0;
  for (std::size_t row = 0; row < x.size(); ++row)
    if (std::abs(x[row].z) < 0.25 * a.body.height && !is_left_out(a, static_cast<Row>(row), left_out)) {
      g.rows.push_back(static_cast<Row>(row));
      mean += x[row].z;
    }
  mean /= static_cast<double>(g.rows.size());
  double square = 0.0;
  for (const Row row : g.rows) square += (x[row].z - mean) * (x[row].z - mean);
  if (!(square > 0.0)) return {};
  for (const Row row : g.rows) g.weights.push_back({0.0, 0.0, -(x[row].z - mean) / square});
  return g;
}

Gauge lateral_gauge(const Assembly& a, std::span<const Gid> left_out) {
  Gauge g;
  const auto& x = a.particles.reference_position;
  const bool x_only = a.body.on_edge || a.space == Space::two_d;
  Vec3 mean;
  const auto add = [&](Row row) {
    if (std::abs(x[row].z) >= 0.2 * a.length() || is_left_out(a, row, left_out)) return;
    g.rows.push_back(row);
    mean += x[row];
  };
  if (a.body.on_edge)
    for (Row row = 0; row < x.size(); ++row) add(row);
  else
    for (const Row row : a.lateral) add(row);
  if (g.rows.empty()) return g;
  mean = (1.0 / static_cast<double>(g.rows.size())) * mean;
  if (x_only) mean.y = 0.0;
  const auto lever = [&](Row row) { return Vec3{x[row].x - mean.x, x_only ? 0.0 : x[row].y - mean.y, 0.0}; };
  double square = 0.0;
  for (const Row row : g.rows) square += dot(lever(row), lever(row));
  if (!(square > 0.0)) return {};
  for (const Row row : g.rows) g.weights.push_back((-1.0 / square) * lever(row));
  return g;
}

double read_gauge(const Gauge& gauge, Strided<const Vec3> position, std::span<const Vec3> reference,
                  const Partition& partition, int threads) {
  std::vector<double> blocks;
  return sum_listed(partition, gauge.rows, threads, blocks, [&](std::size_t k) {
    return dot(gauge.weights[k], position[gauge.rows[k]] - reference[gauge.rows[k]]);
  });
}

Watch watch_of(const Gauge& axial, const Gauge& lateral, std::span<const Vec3> reference,
               const Partition& partition) {
  Watch watch;
  if (axial.rows.empty() && lateral.rows.empty()) return watch;
  watch.weights.assign(reference.size(), {});
  for (const Gauge* gauge : {&axial, &lateral})
    for (std::size_t k = 0; k < gauge->rows.size(); ++k) watch.weights[gauge->rows[k]] += gauge->weights[k];
  std::vector<Vec3> blocks;
  watch.reference = sum_particles(partition, 1, blocks, [&](std::size_t row) {
    const Vec3 &weight = watch.weights[row], &x = reference[row];
    return Vec3{weight.x * x.x, weight.y * x.y, weight.z * x.z};
  });
  return watch;
}

}  // namespace breccia
