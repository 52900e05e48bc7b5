#pragma once
// The reference chain: one plain infrared link that several programs simulate, so that their speeds
// compare. Random 8N1 bytes at 600 baud key a 59 kHz square carrier, half of each cycle lit, at
// 472 kS/s; white Gaussian noise at every sample; two band-pass biquads of Q = 10 at the carrier;
// rectifier; two one-pole low-passes at 700 Hz; a peak tracker (10 ms up, 200 ms down); a Schmitt
// trigger at 0.66 and 0.54 of the peak, read 485 us behind the middle of each bit. Simpler than
// our receiver module, which has a threshold follower, an integrator and an AGC.
#include <memory>
#include <span>

namespace bench {

/// Of the energy of the carrier's fundamental in a mean bit to the noise's density.
constexpr double reference_ebn0_db = 11;
/// What the chain makes of it.
constexpr double reference_ber = 0.0227;

/// One simulation of the chain, of one link or several alike.
class ReferenceChain {
 public:
  struct Tally {
    long bits = 0, errors = 0, samples = 0;  // of all links together
  };
  virtual ~ReferenceChain() = default;
  /// Runs on by so many bits of each link, and counts those.
  virtual Tally run(int bits) = 0;
};

/// A way to write it.
struct ReferenceVariant {
  const char* name;
  std::unique_ptr<ReferenceChain> (*make)();
};
std::span<const ReferenceVariant> reference_variants();

}  // namespace bench
