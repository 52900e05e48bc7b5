// Built once for each instruction set (see CMakeLists.txt), which names the function and, through
// COSYS_ISA, every template in it.
#include "channel/chain_kernel.hpp"

#include "channel/chain_loop.hpp"

namespace channel {

void COSYS_KERNEL(const ChainKernelInput& input) {
  if (input.on_slot != nullptr)
    run_correlator<COSYS_LANES>(input, NoProbe{});
  else
    run_chain<COSYS_LANES>(input, NoProbe{});
}

}  // namespace channel
