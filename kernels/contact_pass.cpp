#include "kernels/contact_pass.hpp"

namespace breccia {
namespace {

template <bool rotation>
Vec3 pressed_force(const ContactPassIn& in, const ContactPassHistory& history, std::size_t c, Vec3& moment) {
  const Index i = in.row_lo[c], j = in.row_hi[c];
  const auto end = [&](Index row) {
    return End<double>{in.position[row], in.velocity[row], rotation ? in.spin[row] : Vec3{}};
  };
  const Pair<double> pair =
      relative_motion<rotation>(ends_of(end(i), end(j)), rotation ? in.arm_offset[c] : 0.0, in.dt);
  Vec3& shear = history.shear_force[c];
  const ContactConstants contact{in.stiffness[c], in.shear_ratio, in.damping.empty() ? 0.0 : in.damping[c],
                                 in.friction};
  shear = carry<rotation>(shear, pair) + (contact.shear_ratio * contact.stiffness) * pair.slip;
  const Vec3 force = linear_contact_force(contact, history.free_length[c] - pair.distance, pair, shear);
  moment = pair.distance * cross(pair.normal, force);
  return force;
}

}  // namespace

void contact_pass(const ContactPassIn& in, const ContactPassHistory& history, std::size_t first,
                  std::size_t last, const Scatter& to) {
  LoadBlock block;
  while (first < last) {
    const std::size_t count = last - first < LoadBlock::capacity ? last - first : LoadBlock::capacity;
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
        history.shear_force[c] = {};
        // a pair that overlapped unbonded from the start presses at its initial distance until it has parted
        const double touch = in.radius[in.row_lo[c]] + in.radius[in.row_hi[c]];
        if (dot(l, l) >= touch * touch) history.free_length[c] = touch;
      }
      block.load[k] = {force, moment};
    }
    if (pressed || to.mode == ScatterMode::column) scatter(to, block, first, count);
    first += count;
  }
}

}  // namespace breccia
