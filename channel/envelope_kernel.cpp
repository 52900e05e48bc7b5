// Built once for each instruction set, as channel/chain_kernel.cpp is.
#include "channel/envelope_kernel.hpp"

#include "channel/envelope_loop.hpp"

namespace channel {

void COSYS_ENVELOPE_KERNEL(const EnvelopeKernelInput& input) {
  EnvelopeLoop<COSYS_LANES>(input).run();
}

}  // namespace channel
