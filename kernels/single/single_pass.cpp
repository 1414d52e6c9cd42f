// The loop over bonds in single precision for each law, compiled once per instruction set.
#include "kernels/loops/kernel_list.hpp"
#include "kernels/math/flatten.hpp"
#include "kernels/single/single_loop.hpp"

namespace breccia::BRECCIA_ISA {
namespace {

template <std::size_t k>
BRECCIA_FLATTEN unsigned single_pass(const SinglePassIn& in, std::size_t first, std::size_t last,
                                     BreakNotes* notes, std::vector<LoadApart>& apart) {
  constexpr Features features = single_list[k].features;
  using Law = std::variant_alternative_t<single_list[k].law, BondLaw>;
  if constexpr (features.several)
    return single_loop<features>(LawTable<Law>{in.laws, in.law}, in, in.sums.data(), first, last, notes,
                                 apart);
  else
    return single_loop<features>(*std::get_if<Law>(in.laws.data()), in, in.sums.data(), first, last, notes,
                                 apart);
}

template <std::size_t... k>
constexpr std::array<SinglePass, sizeof...(k)> all_passes(std::index_sequence<k...>) {
  return {single_pass<k>...};
}

}  // namespace

extern const std::array<SinglePass, single_list.size()> single_passes;
const std::array<SinglePass, single_list.size()> single_passes =
    all_passes(std::make_index_sequence<single_list.size()>{});

}  // namespace breccia::BRECCIA_ISA
