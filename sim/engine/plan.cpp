#include "sim/engine/plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sim {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

/// An interval's width goes with one over the root of the runs.
double times_for_width(double half_width, double wanted) {
  return std::pow(half_width / wanted, 2);
}

double half_width(const Estimate& e) { return (e.high - e.low) / 2; }

double runs_for_width(const RunPilot& pilot) {
  const Estimate& ratio = pilot.ratio;
  if (!(ratio.value > 0)) return endless;
  return pilot.counted * times_for_width(half_width(ratio), pilot.rule.rel_ci * ratio.value);
}

/// Until the interval is no wider than the loss is far from the target; where nothing is lost, its
/// upper end goes with one over the runs.
double runs_for_target(const RunPilot& pilot) {
  const double target = pilot.rule.target_flr;
  const Estimate& loss = pilot.loss;
  if (loss.value == 0) return pilot.counted * loss.high / target;
  return pilot.counted * times_for_width(half_width(loss), std::abs(loss.value - target));
}

double runs_for_losses(const RunPilot& pilot) {
  if (!(pilot.losses > 0)) return endless;
  return static_cast<double>(pilot.rule.max_frame_errors) * pilot.counted / pilot.losses;
}

/// The first number of runs behind which the rule looks.
double next_look_at(double runs, std::uint32_t group) {
  constexpr double most = 4e9;
  if (group > 1 || runs > most) return std::ceil(runs / group) * group;
  return next_look(static_cast<std::uint32_t>(std::ceil(runs)) - 1);
}

}  // namespace

bool may_stop_early(const RunPilot& pilot) {
  return looks_at_ratio(pilot.rule) || pilot.rule.max_frame_errors > 0;
}

double expected_runs(const RunPilot& pilot) {
  const StopRule& rule = pilot.rule;
  double runs = endless;
  const auto expect = [&](double needed) {  // NaN where the pilot knows nothing
    if (needed < runs) runs = needed;
  };
  if (rule.max_frame_errors > 0) expect(runs_for_losses(pilot));
  if (rule.rel_ci > 0) expect(runs_for_width(pilot));
  if (rule.target_flr > 0) expect(runs_for_target(pilot));
  return std::min(next_look_at(std::max(runs, 1.0), pilot.group), static_cast<double>(pilot.runs));
}

/// The last round of the threads takes as long as another, however few have a group left.
double expected_seconds(const RunPilot& pilot) {
  const double round = static_cast<double>(pilot.threads) * pilot.group;
  return pilot.setup_s + std::ceil(expected_runs(pilot) / round) * round * pilot.run_s;
}

double expected_seconds(const std::vector<RunPilot>& pilots) {
  double sum = 0;
  for (const RunPilot& pilot : pilots) sum += expected_seconds(pilot);
  return sum;
}

std::uint64_t runs_within(const std::vector<RunPilot>& pilots, double seconds, double most) {
  const std::uint64_t group = pilots.empty() ? 1 : pilots.front().group;
  const auto fits = [&](std::uint64_t groups) {
    std::vector<RunPilot> limited = pilots;
    for (RunPilot& pilot : limited) pilot.runs = groups * group;
    return expected_seconds(limited) <= seconds;
  };
  std::uint64_t good = 1, bad = static_cast<std::uint64_t>(most) / group + 1;
  while (bad - good > 1) {
    const std::uint64_t middle = good + (bad - good) / 2;
    (fits(middle) ? good : bad) = middle;
  }
  return good * group;
}

}  // namespace sim
