#include "kernels/loops/scatter.hpp"

#include "kernels/loops/scatter_block.hpp"

namespace breccia {

void scatter(const Scatter& to, const ForceBuffer& block, std::size_t first, std::size_t count) {
  scatter_block(to, block, first, count);
}

}  // namespace breccia
