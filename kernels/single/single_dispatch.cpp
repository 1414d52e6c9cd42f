// Chooses the wide loops of single precision, by the processor.
#include <array>
#include <stdexcept>

#include "kernels/loops/kernel_list.hpp"
#include "kernels/single/single.hpp"

namespace breccia {

namespace x86_64 {
extern const std::array<SinglePass, single_list.size()> single_passes;
Integrated integrate_single(const Motion&, const RecordedMotion&, const CollectedSums&, std::size_t,
                            std::size_t, double, const GlobalDamping&, bool);
double single_energy(const SingleEnergyIn&, std::size_t, std::size_t);
unsigned refresh_records(const RecordedMotion&, std::size_t, std::size_t, double);
void collect_sums(const CollectedSums&, std::size_t, std::size_t);
}  // namespace x86_64
namespace x86_64_v3 {
extern const std::array<SinglePass, single_list.size()> single_passes;
Integrated integrate_single(const Motion&, const RecordedMotion&, const CollectedSums&, std::size_t,
                            std::size_t, double, const GlobalDamping&, bool);
double single_energy(const SingleEnergyIn&, std::size_t, std::size_t);
unsigned refresh_records(const RecordedMotion&, std::size_t, std::size_t, double);
void collect_sums(const CollectedSums&, std::size_t, std::size_t);
}  // namespace x86_64_v3
namespace x86_64_v4 {
extern const std::array<SinglePass, single_list.size()> single_passes;
Integrated integrate_single(const Motion&, const RecordedMotion&, const CollectedSums&, std::size_t,
                            std::size_t, double, const GlobalDamping&, bool);
double single_energy(const SingleEnergyIn&, std::size_t, std::size_t);
unsigned refresh_records(const RecordedMotion&, std::size_t, std::size_t, double);
void collect_sums(const CollectedSums&, std::size_t, std::size_t);
}  // namespace x86_64_v4

RefreshRecords refresh_records_for(InstructionSet set) {
  return built_for<RefreshRecords>(set, x86_64::refresh_records, x86_64_v3::refresh_records,
                                   x86_64_v4::refresh_records);
}

IntegrateSingle integrate_single_for(InstructionSet set) {
  return built_for<IntegrateSingle>(set, x86_64::integrate_single, x86_64_v3::integrate_single,
                                    x86_64_v4::integrate_single);
}

SingleEnergy single_energy_for(InstructionSet set) {
  return built_for<SingleEnergy>(set, x86_64::single_energy, x86_64_v3::single_energy,
                                 x86_64_v4::single_energy);
}

CollectSums collect_sums_for(InstructionSet set) {
  return built_for<CollectSums>(set, x86_64::collect_sums, x86_64_v3::collect_sums, x86_64_v4::collect_sums);
}

SinglePass single_pass_for(const BondLaw& law, const Features& built, InstructionSet set) {
  for (std::size_t k = 0; k < single_list.size(); ++k)
    if (single_list[k].law == law.index() && single_list[k].features == built)
      return built_for(set, x86_64::single_passes, x86_64_v3::single_passes, x86_64_v4::single_passes)[k];
  throw std::invalid_argument("no bond kernel is built for these features in single precision");
}

}  // namespace breccia
