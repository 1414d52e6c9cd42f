#include "core/gauges.hpp"

#include <cmath>

namespace breccia {

Gauge axial_gauge(const Assembly& a) {
  Gauge g;
  const auto& x = a.particles.reference_position;
  double mean = 0.0;
  for (std::size_t row = 0; row < x.size(); ++row)
    if (std::abs(x[row].z) < 0.25 * a.body.height) {
      g.rows.push_back(static_cast<Row>(row));
      mean += x[row].z;
    }
  mean /= static_cast<double>(g.rows.size());
  double square = 0.0;
  for (const Row row : g.rows) square += (x[row].z - mean) * (x[row].z - mean);
  for (const Row row : g.rows) g.weights.push_back({0.0, 0.0, -(x[row].z - mean) / square});
  return g;
}

Gauge radial_gauge(const Assembly& a) {
  Gauge g;
  const auto& x = a.particles.reference_position;
  Vec3 mean;
  for (const Row row : a.skin)
    if (std::abs(x[row].z) < 0.2 * a.body.height) {
      g.rows.push_back(row);
      mean += x[row];
    }
  mean = (1.0 / static_cast<double>(g.rows.size())) * mean;
  double square = 0.0;
  for (const Row row : g.rows) square += std::pow(x[row].x - mean.x, 2) + std::pow(x[row].y - mean.y, 2);
  for (const Row row : g.rows)
    g.weights.push_back({-(x[row].x - mean.x) / square, -(x[row].y - mean.y) / square, 0.0});
  return g;
}

double read_gauge(const Gauge& gauge, const std::vector<Vec3>& position, const std::vector<Vec3>& reference) {
  double strain = 0.0;
  for (std::size_t k = 0; k < gauge.rows.size(); ++k)
    strain += dot(gauge.weights[k], position[gauge.rows[k]] - reference[gauge.rows[k]]);
  return strain;
}

}  // namespace breccia
