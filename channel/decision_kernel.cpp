// Built once for each instruction set, as channel/chain_kernel.cpp is.
#include "channel/decision_kernel.hpp"

#include "channel/decision_loop.hpp"

namespace channel {

void COSYS_DECISION_KERNEL(const DecisionKernelInput& input) { run_decisions<dsp::Lanes8>(input); }

}  // namespace channel
