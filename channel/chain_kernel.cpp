// Built once for each instruction set (see CMakeLists.txt), which names the function and, through
// COSYS_ISA, every template in it.
#include "channel/chain_kernel.hpp"

#include "channel/chain_loop.hpp"

namespace channel {

namespace {

using Run = ChainRun<COSYS_LANES>;

void* start(const ChainKernelInput& input) { return new Run(input); }
void advance(void* chain, std::int64_t end) { static_cast<Run*>(chain)->advance(end); }
void stop(void* chain) { delete static_cast<Run*>(chain); }

}  // namespace

LiveKernel COSYS_LIVE_KERNEL() { return {start, advance, stop}; }

void COSYS_KERNEL(const ChainKernelInput& input) {
  if (input.on_slot != nullptr)
    run_correlator<COSYS_LANES>(input, NoProbe{});
  else
    run_chain<COSYS_LANES>(input, NoProbe{});
}

}  // namespace channel
