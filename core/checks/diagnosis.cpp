#include "core/checks/diagnosis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace breccia {
namespace {

/// Contacts that press on a particle now, taken alone with its neighbours fixed: dt^2 k/(2 m), 1
/// where they alone reach the limit of two such particles against each other.
double demand_of_contacts(const World& w, Row row) {
  const ContactTable& c = w.contacts;
  double stiffness = 0.0;
  for (std::size_t k = 0; k < c.size; ++k) {
    if (c.row_lo[k] != row && c.row_hi[k] != row) continue;
    const Vec3 l = w.particles.position[c.row_hi[k]] - w.particles.position[c.row_lo[k]];
    if (norm(l) < c.free_length[k]) stiffness += c.stiffness[k];
  }
  return 0.5 * w.dt * w.dt * stiffness / w.particles.mass[row];
}

}  // namespace

double fastest_wave(const World& w) {
  const ParticleTable& p = w.particles;
  const BondTable& b = w.bonds;
  double square = 0.0;
  for (std::size_t k = 0; k < b.size; ++k) {
    const double m = p.mass[b.row_lo[k]], n = p.mass[b.row_hi[k]];
    square = std::max(square, b.stiffness[k] * (m + n) / (m * n) * b.rest_length[k] * b.rest_length[k]);
  }
  return square > 0.0 ? std::sqrt(square) : std::numeric_limits<double>::infinity();
}

std::string advice(const World& w, Row row) {
  const double lower = 0.5 * w.options.safety;
  if (w.dt > w.critical_dt)
    return fmt::format(
        "likely cause: the step, {:.4g} s, is beyond the critical {:.4g} s; try time.safety = 0.8", w.dt,
        w.critical_dt);
  if (demand_of_contacts(w, row) > 0.5)
    return fmt::format(
        "likely cause: the contacts that have formed on it are stiffer than the bonds that the step was "
        "found from; try time.safety = {:.2g}",
        lower);
  const double platens = std::max(norm(w.platens.velocity[0]), norm(w.platens.velocity[1]));
  // strains at failure are near 1e-3: platens a thousandth as fast as a wave crush what they touch
  if (platens > 1e-3 * fastest_wave(w))
    return fmt::format(
        "likely cause: platens of {:.3g} m/s crush what they touch before the rest feels it; try "
        "test.platen_speed = {:.2g}",
        platens, 0.1 * platens);
  return fmt::format("likely cause: the step is too large for this state; try time.safety = {:.2g}", lower);
}

std::optional<std::string> advice_far_away(double farthest, double size) {
  if (farthest < 1e5 * size) return std::nullopt;
  return fmt::format(
      "likely cause: {:.2g} m from the origin places are rounded to {:.1g} m; move the specimen to the "
      "origin",
      farthest, std::numeric_limits<double>::epsilon() * farthest);
}

std::string advice_for_lost(const World& w, Row row) {
  if (w.dt > w.critical_dt || demand_of_contacts(w, row) > 0.5) return advice(w, row);
  if (w.confinement.pressure > 0.0)
    return fmt::format("likely cause: pressed out between the others; try test.confinement = \"{:.3g} MPa\"",
                       0.5e-6 * w.confinement.pressure);
  const double strain = std::abs(approach(w.platens)) / w.body.height;
  return fmt::format("likely cause: torn off and thrown; end the test sooner, try test.stop_strain = {:.2g}",
                     strain > 0.0 ? 0.5 * strain : 0.01);
}

}  // namespace breccia
