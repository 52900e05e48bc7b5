#pragma once
// Randomness that is addressed, not consumed: a draw is a function of (seed, purpose, point, trial,
// index) alone, so neither threads nor the order of work nor a neighbour can change it.
// Generator: Philox4x32-10, Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC 2011.
#include <array>
#include <cstdint>

namespace dsp {

using PhiloxBlock = std::array<std::uint32_t, 4>;
using PhiloxKey = std::array<std::uint32_t, 2>;

/// Ten rounds of Philox4x32: four words that depend on every bit of counter and key.
PhiloxBlock philox4x32(PhiloxBlock counter, PhiloxKey key);

/// The draws of one purpose in one trial.
struct RandomAddress {
  std::uint64_t seed = 0;
  std::uint32_t point = 0;
  std::uint32_t trial = 0;
  std::uint32_t purpose = 0;

  /// Block number `index` of this address.
  PhiloxBlock block(std::uint32_t index) const;
  /// Uniform on [0, 1), 53 bits.
  double uniform(std::uint32_t index) const;
};

}  // namespace dsp
