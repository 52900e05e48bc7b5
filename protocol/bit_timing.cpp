#include "protocol/bit_timing.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/uart.hpp"

namespace protocol {
namespace {

using dsp::Seconds;

/// Half a bit in ten would need steps of a tenth of a bit in ten: a hundredth. Finer, to begin the
/// refinement well inside the right one.
constexpr double clock_step = 0.004;
constexpr int clock_steps = 15;  // to each side, past most_clock_error
static_assert(clock_step * clock_steps >= most_clock_error);

/// More than that is noise, or the pause between two characters: it counts no more for being worse.
constexpr double most_off = 0.2;  // bits

/// Settles what all periods explain equally well, as one pulse alone.
constexpr double preference_for_nominal = 0.1;  // bits for a clock that is off by 1

double from_whole(double bits) { return bits - std::floor(bits + 0.5); }

/// Times between falls that may lie within one character, in nominal bits.
std::vector<double> fall_distances(std::span<const LightPulse> pulses, Seconds nominal) {
  std::vector<double> distances;
  for (std::size_t i = 1; i < pulses.size(); ++i) {
    const double bits = (pulses[i].fall - pulses[i - 1].fall) / nominal;
    if (bits < bits_per_byte * (1 + most_clock_error)) distances.push_back(bits);
  }
  return distances;
}

double misfit(const std::vector<double>& distances, double period) {
  double sum = preference_for_nominal * std::abs(period - 1);
  for (const double d : distances) sum += std::min(std::abs(from_whole(d / period)), most_off);
  return sum;
}

double best_of_grid(const std::vector<double>& distances) {
  double best = 1, least = misfit(distances, best);
  for (int i = -clock_steps; i <= clock_steps; ++i) {
    const double period = 1 + i * clock_step, sum = misfit(distances, period);
    if (sum < least) best = period, least = sum;
  }
  return best;
}

/// Least squares over the distances that fit.
double refined(const std::vector<double>& distances, double period) {
  double nd = 0, nn = 0;
  for (const double d : distances) {
    const double n = std::floor(d / period + 0.5);
    if (std::abs(d / period - n) < most_off) nd += n * d, nn += n * n;
  }
  return nn > 0 ? nd / nn : period;
}

/// Median over pulses of half a bit or more: shorter ones are pieces.
Seconds lengthening(std::span<const LightPulse> pulses, Seconds period) {
  std::vector<double> off;
  for (const LightPulse& pulse : pulses)
    if (pulse.length() > 0.5 * period) off.push_back(from_whole(pulse.length() / period));
  if (off.empty()) return Seconds(0);
  const auto middle = off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2);
  std::ranges::nth_element(off, middle);
  return *middle * period;
}

}  // namespace

BitTiming estimate_bit_timing(std::span<const LightPulse> pulses, Seconds nominal_period) {
  const auto distances = fall_distances(pulses, nominal_period);
  const Seconds period = refined(distances, best_of_grid(distances)) * nominal_period;
  return {.period = period, .lengthening = lengthening(pulses, period)};
}

std::vector<LightPulse> without_lengthening(std::span<const LightPulse> pulses,
                                            Seconds lengthening) {
  std::vector<LightPulse> light;
  for (const LightPulse& pulse : pulses) {
    const LightPulse bent{pulse.fall, pulse.rise - lengthening};
    if (bent.rise <= bent.fall) continue;
    if (!light.empty() && light.back().rise >= bent.fall)
      light.back().rise = std::max(light.back().rise, bent.rise);
    else
      light.push_back(bent);
  }
  return light;
}

}  // namespace protocol
