// Compiled once per instruction set, as kernels/loops/bond_pass.cpp.
#include "core/studies/layouts/machine_rates.hpp"

#include <experimental/simd>

namespace breccia::BRECCIA_ISA {
namespace {

using Lanes = std::experimental::native_simd<double>;

/// Enough to fill two units with a latency of four or five cycles; with two constants they fit the
/// sixteen registers of the smaller instruction sets.
constexpr std::size_t chains = 12;

void stream(const StreamColumns& s, std::size_t first, std::size_t last, std::size_t sweeps) {
  constexpr auto aligned = std::experimental::element_aligned;
  const Lanes quarter(0.25);
  for (std::size_t n = 0; n < sweeps; ++n)
    for (std::size_t k = first; k + Lanes::size() <= last; k += Lanes::size()) {
      const Lanes sum = (Lanes(s.a + k, aligned) + Lanes(s.b + k, aligned)) +
                        (Lanes(s.c + k, aligned) + Lanes(s.d + k, aligned));
      (quarter * sum).copy_to(s.d + k, aligned);
    }
}

double multiply_add(std::size_t rounds) {
  Lanes sum[chains];
  for (std::size_t k = 0; k < chains; ++k) sum[k] = Lanes(1.0 + static_cast<double>(k));
  double shrink = 0.999999, grow = 1e-6;
  asm volatile("" : "+x"(shrink), "+x"(grow));  // unknown to the compiler
  const Lanes factor(shrink), term(grow);
  for (std::size_t n = 0; n < rounds; ++n)
    for (std::size_t k = 0; k < chains; ++k) sum[k] = sum[k] * factor + term;
  double total = 0;
  for (std::size_t k = 0; k < chains; ++k)
    for (std::size_t lane = 0; lane < Lanes::size(); ++lane) total += sum[k][lane];
  return total;
}

}  // namespace

extern const MachineRates rates;
const MachineRates rates{stream, multiply_add, 2.0 * chains* Lanes::size()};

}  // namespace breccia::BRECCIA_ISA
