// What undamaged bonds store, from what the loop in single precision has of them. Compiled once per
// instruction set.
#include "kernels/single/single_loop.hpp"

namespace breccia::BRECCIA_ISA {

namespace {

/// A sum of floats that does not depend on their order, nor on who shares a register: of numbers
/// that are rounded to multiples of a power of two a double holds sums exactly. What the coarse
/// rounding leaves a second one takes, of floats all, for values between 2^13 and 2^71.
class ExactSum {
public:
  [[gnu::always_inline]] void add(const FloatLanes& values) {
    const Wide v = __builtin_convertvector(std::bit_cast<FloatRegister>(values.v), Wide);
    const Wide high = (v + coarse_unit) - coarse_unit, left = v - high;
    coarse_ += high, fine_ += (left + fine_unit) - fine_unit;
  }
  double value() const {
    double coarse = 0, fine = 0;
    for (std::size_t lane = 0; lane < float_width; ++lane) coarse += coarse_[lane], fine += fine_[lane];
    return coarse + fine;
  }

private:
  using Wide [[gnu::vector_size(8 * float_width)]] = double;
  static constexpr double coarse_unit = 1.5 * 0x1p72, fine_unit = 1.5 * 0x1p42;  // 2^20, 2^-10
  Wide coarse_{}, fine_{};
};

}  // namespace

double single_energy(const SingleEnergyIn& in, std::size_t first, std::size_t last) {
  const FloatLanes count([](auto lane) { return static_cast<float>(lane); });
  const FloatLanes per_moved(in.moved / in.length), ratio(in.shear_ratio), none(0.0);
  ExactSum total;
  for (std::size_t b = first / float_width * float_width; b < last; b += float_width) {
    const BondBlock& block = in.bonds[b / bond_block];
    const RareBlock& rare = in.rare[b / bond_block];
    EndColumns<FloatLanes> ends = ends_of(in, b);
    if (in.before_last_move) ends.place -= per_moved * ends.moved;
    const FloatLanes elastic = motion_of(ends, none, none).longer - lanes_at(block.plastic, b);
    const Vec<FloatLanes> shear{lanes_at(block.shear_x, b), lanes_at(block.shear_y, b),
                                lanes_at(block.shear_z, b)};
    const FloatLanes stiffness = lanes_at(block.stiffness, b);
    FloatLanes twice = stiffness * elastic * elastic;
    if (in.shear_ratio > 0.0) twice += dot(shear, shear) / (ratio * stiffness);
    // a range of rows may begin and end within a batch
    const FloatLanes from(static_cast<double>(first > b ? first - b : 0)),
        to(static_cast<double>(std::min(last - b, float_width)));
    const auto counts = stiffness > none && lanes_at(rare.damage_normal, b) == none &&
                        lanes_at(rare.damage_shear, b) == none && count >= from && count < to;
    total.add(select(counts, twice, none));
  }
  return 0.5 * in.length * in.force * total.value();  // (B50)
}

}  // namespace breccia::BRECCIA_ISA
