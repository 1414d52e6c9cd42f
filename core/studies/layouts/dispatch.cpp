// Chooses what is compiled per instruction set.
#include <stdexcept>

#include "core/studies/layouts/machine_rates.hpp"
#include "core/studies/layouts/stored_pass.hpp"

namespace breccia {

namespace x86_64 {
extern const StoredPass record_pass, block_8_pass, block_16_pass;
extern const SumsPass long_pass, float_pass;
extern const MachineRates rates;
}  // namespace x86_64
namespace x86_64_v3 {
extern const StoredPass record_pass, block_8_pass, block_16_pass;
extern const SumsPass long_pass, float_pass;
extern const MachineRates rates;
}  // namespace x86_64_v3
namespace x86_64_v4 {
extern const StoredPass record_pass, block_8_pass, block_16_pass;
extern const SumsPass long_pass, float_pass;
extern const MachineRates rates;
}  // namespace x86_64_v4

StoredPass stored_pass_for(BondStorage storage, InstructionSet set) {
  switch (storage) {
    case BondStorage::columns:
      break;
    case BondStorage::records:
      return built_for(set, x86_64::record_pass, x86_64_v3::record_pass, x86_64_v4::record_pass);
    case BondStorage::blocks_8:
      return built_for(set, x86_64::block_8_pass, x86_64_v3::block_8_pass, x86_64_v4::block_8_pass);
    case BondStorage::blocks_16:
      return built_for(set, x86_64::block_16_pass, x86_64_v3::block_16_pass, x86_64_v4::block_16_pass);
  }
  throw std::invalid_argument("bonds in columns have production's pass");
}

SumsPass sums_pass_for(SumNumber number, InstructionSet set) {
  switch (number) {
    case SumNumber::int32:
      break;
    case SumNumber::int64:
      return built_for(set, x86_64::long_pass, x86_64_v3::long_pass, x86_64_v4::long_pass);
    case SumNumber::float32:
      return built_for(set, x86_64::float_pass, x86_64_v3::float_pass, x86_64_v4::float_pass);
  }
  throw std::invalid_argument("sums of 32 bits have production's pass");
}

const MachineRates& machine_rates(InstructionSet set) {
  return built_for(set, x86_64::rates, x86_64_v3::rates, x86_64_v4::rates);
}

}  // namespace breccia
