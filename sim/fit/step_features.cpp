#include "sim/fit/step_features.hpp"

#include <algorithm>
#include <cmath>

namespace sim {
namespace {

/// An alignment sets pulses beside bursts, without the delay between them; some come earlier yet.
constexpr double early_cycles = 2;

/// Low time of a recording in a window, and where a pulse begins in it.
class PulseReader {
 public:
  explicit PulseReader(const std::vector<PinPulse>& pulses) : pulses_(pulses) {}

  BurstOutput between(double from, double to) {
    while (next_ < pulses_.size() && pulses_[next_].end_s <= from) ++next_;
    BurstOutput output;
    for (std::size_t i = next_; i < pulses_.size() && pulses_[i].start_s < to; ++i) {
      const PinPulse& pulse = pulses_[i];
      output.low_s += std::min(pulse.end_s, to) - std::max(pulse.start_s, from);
      if (output.share == 0 && pulse.start_s >= from) {
        output.start_s = pulse.start_s - from;
        output.begins = true;
      }
      output.share = 1;
    }
    return output;
  }

 private:
  const std::vector<PinPulse>& pulses_;
  std::size_t next_ = 0;
};

}  // namespace

std::vector<std::size_t> first_bursts(const Plan& plan) {
  std::vector<std::size_t> first{0};
  for (const PlanStep& step : plan.steps) first.push_back(first.back() + step.repeats);
  return first;
}

bool is_long_carrier(const PlanStep& step) {
  constexpr double long_s = 20e-3;
  return step.repeats == 1 && static_cast<double>(step.cycles_on) / step.carrier_hz > long_s;
}

std::vector<BurstOutput> recorded_bursts(const Plan& plan, const PinRecording& recording,
                                         const PlanAlignment& alignment) {
  std::vector<BurstOutput> bursts;
  PulseReader reader(recording.pulses);
  for (std::size_t s = 0; s < plan.steps.size(); ++s) {
    const PlanStep& step = plan.steps[s];
    const double cycle = 1 / step.carrier_hz;
    const double early = early_cycles * cycle;
    const double on = static_cast<double>(step.cycles_on) * cycle;
    const double period = on + static_cast<double>(step.cycles_off) * cycle;
    const double next_step =
        s + 1 < plan.steps.size() ? plan.steps[s + 1].start_ms * 1e-3 : HUGE_VAL;
    constexpr double tail_s = 10e-3;
    for (std::uint64_t i = 0; i < step.repeats; ++i) {
      const double start = step.start_ms * 1e-3 + static_cast<double>(i) * period;
      const double next = i + 1 < step.repeats
                              ? start + period
                              : std::min({start + std::max(period, on) + tail_s, next_step});
      const double from = alignment.recorded_s(start - early);
      const double to = alignment.recorded_s(next - early);
      BurstOutput burst = reader.between(from, to);
      burst.low_s /= 1 + alignment.clock_error;
      burst.start_s = burst.start_s / (1 + alignment.clock_error) - early;
      bursts.push_back(burst);
    }
  }
  return bursts;
}

StepFeatures features_of(const PlanStep& step, std::span<const BurstOutput> bursts,
                         std::span<const BurstOutput> others) {
  StepFeatures features;
  const double on = static_cast<double>(step.cycles_on) / step.carrier_hz;
  const bool is_carrier = is_long_carrier(step);
  double low = 0, start = 0;
  for (std::size_t i = 0; i < bursts.size(); ++i) {
    const BurstOutput& burst = bursts[i];
    const double whole = is_carrier ? on : 0.6 * on;
    features.reported +=
        is_carrier ? burst.low_s / whole : burst.share * std::min(1.0, burst.low_s / whole);
    if (burst.share < 0.5 || others[i].share < 0.5) continue;
    const bool is_last =
        bursts.size() > 1 &&
        (i + 1 == bursts.size() || bursts[i + 1].share < 0.5 || others[i + 1].share < 0.5);
    if (!is_carrier && !is_last) low += burst.low_s, ++features.with_low;
    if (burst.begins && others[i].begins) start += burst.start_s, ++features.with_start;
  }
  if (features.with_low > 0) features.low_s = low / features.with_low;
  if (features.with_start > 0) features.start_s = start / features.with_start;
  return features;
}

}  // namespace sim
