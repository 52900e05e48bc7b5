#pragma once
// The border between decisions (channel/decision.hpp) and their kernels, which obeys the rules of
// channel/chain_kernel.hpp: only plain data crosses.
#include <array>
#include <cstddef>
#include <cstdint>

namespace channel {

/// What a kernel knows of a bit. With x, y the in-phase and quadrature noise in standard deviations
/// it is taken for light if x > limit (in phase) or slope x + x^2 + y^2 > limit (envelope).
struct DecisionBit {
  float slope;  // of the envelope alone
  float limit;
  float reach;  // where NormalSource's uniform number is above, noise does not reach the threshold;
                // in phase the larger one of each two bits
};

struct DecisionKernelInput {
  const std::array<std::uint32_t, 4>* noise_seed = nullptr;  // of each lane
  const DecisionBit* bits = nullptr;
  std::size_t n_bits = 0;  // even
  bool envelope = false;
  const std::uint8_t* sent = nullptr;  // of each bit: 0xff light, 0 dark
  /// Of each bit: bit i says whether lane i takes it for what it is not. Holds what is so without
  /// noise, and is written where noise may reach the threshold.
  std::uint8_t* wrong = nullptr;
};

void decide_lanes_baseline(const DecisionKernelInput& input);
void decide_lanes_v3(const DecisionKernelInput& input);  // x86-64-v3: AVX2 and FMA

}  // namespace channel
