#include "sim/fit/plan_alignment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "sim/failure.hpp"

namespace sim {
namespace {

constexpr double most_clock_error = 0.03;
constexpr double jitter_s = 0.8e-3;  // by which a pulse may be off, the clock aside
constexpr double dark_s = 25e-3;     // before a burst that comes out of the dark

struct Onset {
  double at_s;
  double dark_before_s;
};

/// Bursts of the plan with dark before them; the first is one.
std::vector<Onset> onsets_of(const Plan& plan) {
  std::vector<Onset> onsets;
  double lit_until = -1;
  for (const PlanStep& step : plan.steps) {
    const double cycle = 1 / step.carrier_hz;
    const double start = step.start_ms * 1e-3;
    const double dark = onsets.empty() ? 1 : start - lit_until;
    if (dark >= dark_s) onsets.push_back({start, dark});
    const double on = static_cast<double>(step.cycles_on) * cycle;
    const double period = on + static_cast<double>(step.cycles_off) * cycle;
    lit_until = start + static_cast<double>(step.repeats - 1) * period + on;
  }
  return onsets;
}

/// Pulses with dark before them. What the pin does after light that is not reported is none.
std::vector<Onset> onsets_of(const PinRecording& recording) {
  std::vector<Onset> onsets;
  double before = recording.begin_s - 1;
  for (const PinPulse& pulse : recording.pulses) {
    const double dark = pulse.start_s - before;
    if (dark >= dark_s * (1 - most_clock_error)) onsets.push_back({pulse.start_s, dark});
    before = pulse.end_s;
  }
  return onsets;
}

/// Pairs of plan and recording, from one pair on: each new one corrects the clock.
class Chain {
 public:
  Chain(const std::vector<Onset>& planned, const std::vector<Onset>& heard)
      : planned_(planned), heard_(heard) {}

  PlanAlignment from(std::size_t i, std::size_t j) const {
    Line line(planned_[i].at_s, heard_[j].at_s);
    std::size_t next = j + 1;
    int matched = 1;
    for (std::size_t p = i + 1; p < planned_.size() && next < heard_.size(); ++p) {
      const double due = line.at(planned_[p].at_s);
      const double around = line.tolerance(planned_[p].at_s);
      while (next < heard_.size() && heard_[next].at_s < due - around) ++next;
      if (next == heard_.size() || heard_[next].at_s > due + around) continue;
      line.add(planned_[p].at_s, heard_[next].at_s);
      ++matched;
      ++next;
    }
    PlanAlignment alignment = line.alignment();
    alignment.matched = matched;
    return alignment;
  }

 private:
  /// The straight line through pairs, with a prior of slope 1.
  class Line {
   public:
    Line(double x, double y) : x0_(x), y0_(y) { add(x, y); }
    void add(double x, double y) {
      const double dx = x - x0_, dy = y - y0_ - dx;
      n_ += 1, sx_ += dx, sy_ += dy, sxx_ += dx * dx, sxy_ += dx * dy;
      last_ = dx;
    }
    double slope() const {
      const double spread = sxx_ - sx_ * sx_ / n_;
      return spread > 0 ? (sxy_ - sx_ * sy_ / n_) / spread : 0;
    }
    double at(double x) const {
      const double dx = x - x0_;
      return y0_ + dx + (sy_ - slope() * sx_) / n_ + slope() * dx;
    }
    /// The slope is known the better the longer the line is.
    double tolerance(double x) const {
      const double known = last_ > 0 ? jitter_s / last_ : most_clock_error;
      return jitter_s + std::min(known, most_clock_error) * (x - x0_ - last_);
    }
    PlanAlignment alignment() const {
      return {.start_s = at(0), .clock_error = slope(), .matched = 0};
    }

   private:
    double x0_, y0_, last_ = 0;
    double n_ = 0, sx_ = 0, sy_ = 0, sxx_ = 0, sxy_ = 0;
  };

  const std::vector<Onset>& planned_;
  const std::vector<Onset>& heard_;
};

/// How many bursts of any plan are in any recording, at the best of all the places that are tried.
int most_by_chance(std::size_t planned, std::size_t heard, double recorded_s) {
  const double a_pulse = static_cast<double>(heard) * 2 * jitter_s / recorded_s;
  const double usual = static_cast<double>(planned) * std::min(a_pulse, 1.0);
  return static_cast<int>(3 + usual + 5 * std::sqrt(usual));
}

/// Where a recording lasts about a thousand times as long as its plan, or a million times, its
/// times are hardly seconds.
std::string what_to_look_at(double planned_s, double recorded_s) {
  const double times = recorded_s / planned_s;
  for (const auto& [unit, ticks] : {std::pair{"ms", 1e3}, {"us", 1e6}, {"ns", 1e9}})
    if (times > 0.1 * ticks && times < 10 * ticks)
      return fmt::format("its times may be in {0}: say --time-unit {0}", unit);
  return "look whether plan and capture belong together";
}

void refuse_chance(int matched, std::size_t planned, int by_chance, const std::string& suggestion) {
  const int needed = by_chance + 1;
  if (matched >= needed) return;
  throw bad_input(
      fmt::format("the recording does not follow the plan: {} of its {} bursts are found", matched,
                  planned),
      fmt::format("{} at least must be, within 3 % of its time", needed), suggestion);
}

}  // namespace

PlanAlignment align(const Plan& plan, const PinRecording& recording) {
  const std::vector<Onset> planned = onsets_of(plan), heard = onsets_of(recording);
  const Chain chain(planned, heard);
  constexpr std::size_t tried = 40;  // of either: weak steps at first, noise before the plan
  PlanAlignment best;
  for (std::size_t i = 0; i < std::min(tried, planned.size()); ++i)
    for (std::size_t j = 0; j < std::min(tried, heard.size()); ++j) {
      const PlanAlignment one = chain.from(i, j);
      if (one.matched > best.matched) best = one;
    }
  const double recorded_s = std::max(recording.end_s - recording.begin_s, 1.0);
  const double planned_s = 1e-3 * (end_ms(plan.steps.back()) - plan.steps.front().start_ms);
  refuse_chance(best.matched, planned.size(),
                most_by_chance(planned.size(), heard.size(), recorded_s),
                what_to_look_at(planned_s, recorded_s));
  return best;
}

}  // namespace sim
