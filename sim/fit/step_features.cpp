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

double first_run_of(std::span<const BurstOutput> bursts) {
  double reported = 0, unreported = 0, all_were = 1, none_was = 1;
  for (const BurstOutput& burst : bursts) {
    all_were *= burst.share;
    none_was *= 1 - burst.share;
    if (all_were + none_was < 1e-3) break;
    reported += all_were;
    unreported += none_was;
  }
  return reported - unreported;
}

/// Bursts whose pulses are of no less than a share of them; of a carrier the share that is low.
double reported_of(const PlanStep& step, std::span<const BurstOutput> bursts) {
  constexpr double least_share = 0.6;
  const double on = static_cast<double>(step.cycles_on) / step.carrier_hz;
  if (is_long_carrier(step)) return bursts.empty() ? 0 : bursts.front().low_s / on;
  const double a_second = 1 / (least_share * on);
  double reported = 0;
  for (const BurstOutput& burst : bursts)
    reported += burst.share * std::min(1.0, burst.low_s * a_second);
  return reported;
}

double dark_before_ms(const Plan& plan, std::size_t s) {
  return s == 0 ? HUGE_VAL : plan.steps[s].start_ms - end_ms(plan.steps[s - 1]);
}

/// Seldom enough, and dark before them.
bool is_short_at_rest(const Plan& plan, std::size_t s) {
  constexpr double longest_cycles = 40, least_dark_ms = 40;
  const PlanStep& step = plan.steps[s];
  return static_cast<double>(step.cycles_on) <= longest_cycles &&
         dark_before_ms(plan, s) >= least_dark_ms && !is_train(step) && !is_behind_carrier(plan, s);
}

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

bool is_train(const PlanStep& step) {
  constexpr double most_duty_at_rest = 0.08;
  const auto on = static_cast<double>(step.cycles_on), off = static_cast<double>(step.cycles_off);
  return step.repeats > 1 && on / (on + off) > most_duty_at_rest;
}

bool is_behind_carrier(const Plan& plan, std::size_t step) {
  constexpr double soon_ms = 50;
  if (is_long_carrier(plan.steps[step])) return false;
  for (std::size_t s = step; s > 0 && dark_before_ms(plan, s) < soon_ms; --s)
    if (is_long_carrier(plan.steps[s - 1])) return true;
  return false;
}

bool is_burst_or_carrier(const Plan& plan, std::size_t step) {
  return is_short_at_rest(plan, step) || is_long_carrier(plan.steps[step]);
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

StepFeatures features_of(const PlanStep& step, std::span<const BurstOutput> bursts) {
  StepFeatures features;
  features.reported = reported_of(step, bursts);
  if (is_train(step)) features.first_run = first_run_of(bursts);
  return features;
}

void take_means(const PlanStep& step, std::span<const BurstOutput> bursts,
                std::span<const BurstOutput> others, StepFeatures& features) {
  const bool is_of_train = is_train(step), is_carrier = is_long_carrier(step);
  const auto both = [&](std::size_t i) {
    return i < bursts.size() && bursts[i].share >= 0.5 && others[i].share >= 0.5;
  };
  double low = 0, start = 0;
  features.with_low = features.with_start = 0;
  for (std::size_t i = 0; i < bursts.size(); ++i) {
    if (!both(i)) {
      if (is_of_train && features.with_low > 0) break;
      continue;
    }
    const bool is_last = bursts.size() > 1 && !both(i + 1);
    if (!is_carrier && !is_last) low += bursts[i].low_s, ++features.with_low;
    if (!is_of_train && bursts[i].begins && others[i].begins)
      start += bursts[i].start_s, ++features.with_start;
  }
  features.low_s = features.with_low > 0 ? low / features.with_low : 0;
  features.start_s = features.with_start > 0 ? start / features.with_start : 0;
}

}  // namespace sim
