#include "sim/link/sampled_theory.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "sim/link/theory.hpp"

namespace sim {
namespace {

using std::numbers::pi;

/// Samples that are looked at, and bits of which they are.
constexpr double most_samples = 5e5, longest_bit = 2.5e5;
constexpr int fewest_draws = 16, most_draws = 256;

/// Cycles of light of a square carrier from phase 0 to phase p >= 0.
double lit_cycles(double p, double duty) {
  const auto whole = static_cast<double>(static_cast<std::int64_t>(p));
  return whole * duty + std::min(p - whole, duty);
}

/// A bit at one place between samples and at one phase, and what the correlator makes of it.
class SampledBit {
 public:
  SampledBit(const channel::ChainDesign& chain, double length, double phase, double begin)
      : carrier_(chain.carrier),
        cycles_(chain.carrier.step * 0x1p-32),
        phase_(phase),
        samples_(channel::slot_samples({dsp::Seconds(begin), dsp::Seconds(begin + length)},
                                       dsp::Hertz(1))) {
    const auto first = static_cast<double>(samples_.begin);
    const auto last = static_cast<double>(samples_.end - 1);
    add_samples(begin, begin + length);
    if (begin > first) before_ = light(first, begin) * tone(first);
    if (begin + length < last + 1) behind_ = light(begin + length, last + 1) * tone(last);
  }

  /// Amplitude of the fundamental, in phase and in quadrature.
  std::complex<double> amplitude(bool lit, bool before, bool behind) const {
    const auto sum = (lit ? inside_ : 0.0) + (before ? before_ : 0.0) + (behind ? behind_ : 0.0);
    return 2.0 / static_cast<double>(count()) * sum;
  }
  /// Of its part in phase, for a sample's deviation.
  double deviation(double sample) const {
    return 2 * sample * std::sqrt(squares_) / static_cast<double>(count());
  }

 private:
  std::int64_t count() const { return samples_.end - samples_.begin; }
  std::complex<double> tone(double sample) const {
    return std::polar(
        1.0, 2 * pi * (phase_ + cycles_ * (sample + 0.5) - static_cast<double>(carrier_.duty) / 2));
  }
  double light(double from, double to) const {
    return carrier_light(carrier_, phase_ + cycles_ * from, phase_ + cycles_ * to);
  }

  void add_samples(double begin, double end) {
    for (std::int64_t i = samples_.begin; i < samples_.end; ++i) {
      const auto at = static_cast<double>(i);
      const std::complex<double> here = tone(at);
      inside_ += light(std::max(at, begin), std::min(at + 1, end)) * here;
      squares_ += here.real() * here.real();
    }
  }

  const channel::CarrierDesign& carrier_;
  double cycles_, phase_;
  channel::SlotSamples samples_;
  std::complex<double> inside_{}, before_{}, behind_{};  // if the bit, and those beside it, are lit
  double squares_ = 0;
};

/// How often a bit has this level with these beside it; a line is dark before and behind.
struct BitKinds {
  std::array<double, 8> share{};

  explicit BitKinds(const protocol::Bytes& bytes) {
    const std::vector<bool> dark = protocol::line_bits(bytes);
    for (std::size_t i = 0; i < dark.size(); ++i) {
      const bool before = i > 0 && !dark[i - 1];
      const bool behind = i + 1 < dark.size() && !dark[i + 1];
      share[kind(!dark[i], before, behind)] += 1 / static_cast<double>(dark.size());
    }
  }
  static std::size_t kind(bool lit, bool before, bool behind) {
    return (lit ? 4U : 0U) + (before ? 2U : 0U) + (behind ? 1U : 0U);
  }
};

double error_ratio(const channel::IdealDesign& receiver, bool lit, std::complex<double> amplitude,
                   double deviation) {
  const double threshold = receiver.threshold / deviation;
  if (receiver.statistic == channel::IdealDesign::Statistic::envelope) {
    const double a = std::abs(amplitude) / deviation;
    return lit ? marcum_p1(a, threshold) : marcum_q1(a, threshold);
  }
  const double a = amplitude.real() / deviation;
  return lit ? gaussian_q(a - threshold) : gaussian_q(threshold - a);
}

}  // namespace

double carrier_light(const channel::CarrierDesign& carrier, double from, double to) {
  const auto duty = static_cast<double>(carrier.duty);
  return static_cast<double>(carrier.amplitude) * (lit_cycles(to, duty) - lit_cycles(from, duty));
}

double sampled_ber(const channel::ChainDesign& chain, const channel::IdealDesign& receiver,
                   dsp::Hertz baud, const protocol::Bytes& bytes) {
  const BitKinds kinds(bytes);
  const double length = chain.sample_rate / baud;
  if (length > longest_bit) return std::numeric_limits<double>::quiet_NaN();
  const int draws = std::clamp(static_cast<int>(most_samples / length), fewest_draws, most_draws);
  double sum = 0;
  for (int i = 0; i < draws; ++i) {
    // Even in two dimensions: phases in steps, places by the golden ratio.
    const double place = std::fmod((i + 0.5) * std::numbers::phi, 1.0);
    const SampledBit bit(chain, length, (i + 0.5) / draws, 1 + place);
    for (std::size_t kind = 0; kind < kinds.share.size(); ++kind) {
      if (kinds.share[kind] == 0) continue;
      const bool lit = (kind & 4U) != 0;
      const auto sample = static_cast<double>(lit ? chain.noise_lit : chain.noise_dark);
      sum += kinds.share[kind] * error_ratio(receiver, lit,
                                             bit.amplitude(lit, (kind & 2U) != 0, (kind & 1U) != 0),
                                             bit.deviation(sample));
    }
  }
  return sum / draws;
}

}  // namespace sim
