// Chooses what is compiled per instruction set.
#include <stdexcept>

#include "core/layouts/machine_rates.hpp"
#include "core/layouts/stored_pass.hpp"

namespace breccia {

namespace x86_64 {
extern const StoredPass record_pass, block_8_pass, block_16_pass;
extern const MachineRates rates;
}  // namespace x86_64
namespace x86_64_v3 {
extern const StoredPass record_pass, block_8_pass, block_16_pass;
extern const MachineRates rates;
}  // namespace x86_64_v3
namespace x86_64_v4 {
extern const StoredPass record_pass, block_8_pass, block_16_pass;
extern const MachineRates rates;
}  // namespace x86_64_v4

StoredPass stored_pass_for(BondStorage storage, InstructionSet set) {
  const auto choose = [&](StoredPass narrow, StoredPass middle, StoredPass wide) {
    return set == InstructionSet::x86_64 ? narrow : set == InstructionSet::x86_64_v3 ? middle : wide;
  };
  switch (storage) {
    case BondStorage::columns:
      break;
    case BondStorage::records:
      return choose(x86_64::record_pass, x86_64_v3::record_pass, x86_64_v4::record_pass);
    case BondStorage::blocks_8:
      return choose(x86_64::block_8_pass, x86_64_v3::block_8_pass, x86_64_v4::block_8_pass);
    case BondStorage::blocks_16:
      return choose(x86_64::block_16_pass, x86_64_v3::block_16_pass, x86_64_v4::block_16_pass);
  }
  throw std::invalid_argument("bonds in columns have production's pass");
}

const MachineRates& machine_rates(InstructionSet set) {
  switch (set) {
    case InstructionSet::x86_64:
      return x86_64::rates;
    case InstructionSet::x86_64_v3:
      return x86_64_v3::rates;
    case InstructionSet::x86_64_v4:
      return x86_64_v4::rates;
  }
  throw std::invalid_argument("no such instruction set");
}

}  // namespace breccia
