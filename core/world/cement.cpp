#include "core/world/cement.hpp"

#include "kernels/loops/bond_energy.hpp"
#include "kernels/loops/moment_couple.hpp"

namespace breccia {
namespace {

MomentStiffness stiffness_of_moments(const World& w, std::size_t k) {
  return moment_stiffness(w.bonds.stiffness[k], of_law(w.shear_ratio, w.bonds.law, k) * w.bonds.stiffness[k],
                          w.bonds.area[k], w.space == Space::two_d);
}

/// What the bond pass of the next step, and the record of cracks, are to find. What the normal
/// spring and the moment still stored is lost at once; the shear is left to friction.
/// @param stretching  m, of this step, for what the last pull still does in the next
void tear(World& w, std::size_t k, CementState state, double pull, double stretching, double stored,
          BreakNotes* notes, bool booked) {
  BondTable& b = w.bonds;
  if (notes) {
    if (notes->count < notes->room.size())
      notes->room[notes->count] = {
          static_cast<Index>(k), {b.shear_x[k], b.shear_y[k], b.shear_z[k]}, 0.0, 0.0, 0.0};
    ++notes->count;
  }
  (state == CementState::torn ? b.damage_normal : b.damage_shear)[k] = 1.0;
  b.couple[k] = {};
  if (!w.ledger.enabled) return;
  b.spring_force[k] = pull;  // this step still ended with them
  b.shear_factor[k] = 1.0;
  if (pull > 0.0) stored += 0.5 * pull * pull / b.stiffness[k] + 0.5 * pull * stretching;
  if (booked) w.ledger.bonds[k / ForceBuffer::capacity].failure += stored;
}

}  // namespace

bool bend(World& w, std::size_t k, BreakNotes* notes, bool booked) {
  BondTable& b = w.bonds;
  if (!(b.stiffness[k] > 0.0)) return false;
  const ParticleTable& p = w.particles;
  const Row lo = b.row_lo[k], hi = b.row_hi[k];
  const auto end = [&](Row row) { return End<double>{p.position[row], p.velocity[row], p.spin[row]}; };
  const Pair<double> pair = relative_motion<true>(ends_of(end(lo), end(hi)), b.arm_offset[k], w.dt);
  const MomentStiffness stiffness = stiffness_of_moments(w, k);
  b.couple[k] = moment_after(b.couple[k], pair, p.spin[lo], p.spin[hi], stiffness, w.dt);
  if (!w.features.breakage) return true;
  const auto& law = std::get<ParallelBondLaw>(w.laws[b.law.empty() ? 0 : b.law[k]]);
  const Moment moment = moment_of(b.couple[k], pair.normal);
  const double pull = b.stiffness[k] * (pair.distance - b.rest_length[k]);
  const double shear = norm(Vec3{b.shear_x[k], b.shear_y[k], b.shear_z[k]});
  const CementState state = cement_state(law, limits_of(law, constants_of_bond(b, k)), pull, shear, moment,
                                         constants_of_bond(b, k).strength_area, w.space == Space::two_d);
  if (state == CementState::holds) return true;
  // the torn moment is passed on no more: half of this step's work on it was not done
  const double undone = 0.5 * w.dt * dot(b.couple[k], p.spin[hi] - p.spin[lo]);
  tear(w, k, state, pull, pair.stretching, moment_energy(moment, stiffness) - undone, notes, booked);
  return true;
}

void drop_moment(World& w, std::size_t k, bool booked) {
  BondTable& b = w.bonds;
  if (b.couple[k] == Vec3{}) return;
  if (w.ledger.enabled && booked) w.ledger.bonds[k / ForceBuffer::capacity].failure += moment_energy(w, k);
  b.couple[k] = {};
}

double moment_energy(const World& w, std::size_t k) {
  const BondTable& b = w.bonds;
  if (!(b.stiffness[k] > 0.0)) return 0.0;
  const auto& x = w.particles.position;
  const Vec3 l = x[b.row_hi[k]] - x[b.row_lo[k]];
  return moment_energy(moment_of(b.couple[k], (1.0 / norm(l)) * l), stiffness_of_moments(w, k));
}

}  // namespace breccia
