#include "kernels/loops/contact_pass.hpp"

namespace breccia {
namespace {

ContactConstants constants_of_contact(const ContactPassIn& in, std::size_t c) {
  const std::size_t law = in.law.empty() ? 0 : in.law[c];
  const bool hertz = !in.hertz_normal.empty();
  return {in.stiffness[c],
          in.shear_ratio[law],
          in.damping.empty() ? 0.0 : in.damping[c],
          in.friction[law],
          hertz ? in.hertz_normal[c] : 0.0,
          hertz ? in.hertz_tangential[c] : 0.0};
}

template <bool rotation>
Ends<double> ends_of_contact(const ContactPassIn& in, std::size_t c) {
  const auto end = [&](Index row) {
    return End<double>{in.position[row], in.velocity[row], rotation ? in.spin[row] : Vec3{}};
  };
  return ends_of(end(in.row_lo[c]), end(in.row_hi[c]));
}

/// J, in the spring across.
double friction_energy(const Vec3& shear, double stiffness) {
  return stiffness > 0.0 ? 0.5 * dot(shear, shear) / stiffness : 0.0;
}

/// Books the step of a contact: trapezoids, with the forces that the step before ended with.
/// @param rotated  N, friction force as it came into the step, turned with the pair
/// @param along    N, force along the normal with the dashpot; tension positive
void book(const ContactPassIn& in, const ContactPassHistory& history, std::size_t c, const Ends<double>& ends,
          const Pair<double>& pair, const Vec3& rotated, double along) {
  const ContactConstants contact = constants_of_contact(in, c);
  const double overlap = larger(0.0, history.free_length[c] - pair.distance);
  const SurfaceSpring spring = surface_spring(contact, overlap);
  const double viscous = along + spring.force;
  const Vec3& shear = history.shear_force[c];
  ContactLosses& loss = history.losses[c / ForceBuffer::capacity];
  // (B55)
  loss.viscous += 0.5 * (history.viscous_force[c] + viscous) * elongation(ends, pair, in.dt);
  const double before = larger(0.0, history.free_length[c] - pair.distance + pair.stretching);
  const double kept = friction_energy(shear, spring.across) -
                      friction_energy(rotated, surface_spring(contact, before).across);
  loss.friction += 0.5 * dot(rotated + shear, pair.slip) - kept;  // (B53)
  history.viscous_force[c] = viscous;
}

template <bool rotation>
Vec3 pressed_force(const ContactPassIn& in, const ContactPassHistory& history, std::size_t c, Vec3& moment) {
  const Ends<double> ends = ends_of_contact<rotation>(in, c);
  const Pair<double> pair = relative_motion<rotation>(ends, rotation ? in.arm_offset[c] : 0.0, in.dt);
  Vec3& shear = history.shear_force[c];
  const ContactConstants contact = constants_of_contact(in, c);
  const Vec3 rotated = rotate_with_pair<rotation>(shear, pair);
  const double overlap = history.free_length[c] - pair.distance;
  const double across = surface_spring(contact, larger(0.0, overlap)).across;
  shear = friction_held(contact, rotated, overlap, overlap + pair.stretching) + across * pair.slip;
  const Vec3 force = surface_force(contact, overlap, pair, shear);
  moment = pair.distance * cross(pair.normal, force);
  if (!history.losses.empty()) book(in, history, c, ends, pair, rotated, dot(force - shear, pair.normal));
  return force;
}

/// A pair that has just parted lets its forces go.
template <bool rotation>
void release(const ContactPassIn& in, const ContactPassHistory& history, std::size_t c) {
  Vec3& shear = history.shear_force[c];
  if (!history.losses.empty() && (history.viscous_force[c] != 0.0 || !(shear == Vec3{}))) {
    const Ends<double> ends = ends_of_contact<rotation>(in, c);
    const Pair<double> pair = relative_motion<rotation>(ends, rotation ? in.arm_offset[c] : 0.0, in.dt);
    const Vec3 rotated = rotate_with_pair<rotation>(shear, pair);
    shear = {};
    book(in, history, c, ends, pair, rotated, 0.0);
  }
  shear = {};
}

}  // namespace

void contact_pass(const ContactPassIn& in, const ContactPassHistory& history, std::size_t first,
                  std::size_t last, const Scatter& to) {
  ForceBuffer block;
  while (first < last) {
    const std::size_t count = last - first < ForceBuffer::capacity ? last - first : ForceBuffer::capacity;
    bool pressed = false;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t c = first + k;
      const Vec3 l = in.position[in.row_hi[c]] - in.position[in.row_lo[c]];
      const double reach = history.free_length[c];
      Vec3 force, moment;
      if (dot(l, l) < reach * reach) {
        force = in.rotation ? pressed_force<true>(in, history, c, moment)
                            : pressed_force<false>(in, history, c, moment);
        pressed = true;
      } else {
        in.rotation ? release<true>(in, history, c) : release<false>(in, history, c);
        // a pair that overlapped unbonded from the start presses at its initial distance until it
        // has parted
        const double touch = in.radius[in.row_lo[c]] + in.radius[in.row_hi[c]];
        if (dot(l, l) >= touch * touch) history.free_length[c] = touch;  // (B31)
      }
      block.load[k] = {force, moment};
    }
    if (pressed || to.mode == ScatterMode::column) scatter(to, block, first, count);
    first += count;
  }
}

}  // namespace breccia
