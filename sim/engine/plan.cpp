#include "sim/engine/plan.hpp"

#include <algorithm>
#include <cmath>

#include "sim/counting/statistics.hpp"
#include "sim/engine/batch_sizes.hpp"
#include "sim/engine/engine.hpp"
#include "sim/engine/experiment.hpp"
#include "sim/link/link.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/scenario/sweep.hpp"

namespace sim {
namespace {

constexpr double most_frames = 4e9;  // of a point: trials are numbered in 32 bits

double loss(const Tally& t) { return ratio(t.n_frames_lost, t.n_frames); }

/// An interval's width goes with one over the root of the frames.
double frames_for_width(const Pilot& pilot) {
  const Estimate ber = bit_error_ratio(pilot.tally, 0.95);
  if (!(ber.value > 0)) return most_frames;
  const double times = (ber.high - ber.low) / 2 / ber.value / pilot.rule.rel_ci;
  return static_cast<double>(pilot.tally.n_frames) * times * times;
}

/// Until the loss is 3.3 standard deviations (99.9 %) from the target; or, where nothing is lost,
/// until chance would have lost a frame of that target in 99.95 %.
double frames_for_target(const Pilot& pilot) {
  const double target = pilot.rule.target_flr, p = loss(pilot.tally);
  if (p == 0) return std::log(2000) / -std::log1p(-std::min(target, 0.999));
  return 3.3 * 3.3 * p * (1 - p) / ((p - target) * (p - target));
}

/// Frames of a pilot for each thread: where a trial takes a microsecond, enough to see more of them
/// than of starting threads.
std::uint64_t pilot_frames(const Link& link) { return (link.decisions ? 1024 : 4) * group_size; }

double in_groups(double frames) { return std::ceil(frames / group_size) * group_size; }

}  // namespace

std::vector<Pilot> run_pilots(const LoadedScenario& scenario, const Shard& shard,
                              const Workers& workers) {
  std::vector<Pilot> pilots;
  for (std::size_t i = 0; i < count_points(scenario.sweep); ++i) {
    std::vector<double> coordinates = point_coordinates(scenario.sweep, i);
    const Scenario point = point_scenario(scenario, coordinates);
    const Link link = make_link(point);
    const StopRule few{.max_frames =
                           pilot_frames(link) * static_cast<std::uint64_t>(workers.threads)};
    const PointResult counted =
        run_point(link, few, {.threads = workers.threads, .interrupt = workers.interrupt});
    if (workers.interrupted()) break;
    pilots.push_back({std::move(coordinates), share_of(rule_of(point.stop), shard), counted.tally,
                      counted.elapsed_s / static_cast<double>(counted.tally.n_frames)});
  }
  return pilots;
}

double expected_frames(const Pilot& pilot) {
  const StopRule& rule = pilot.rule;
  double frames = most_frames;
  const double lost = worth_of_losses(pilot.tally);
  if (rule.max_frame_errors > 0 && lost > 0)
    frames = static_cast<double>(rule.max_frame_errors) *
             static_cast<double>(pilot.tally.n_frames) / lost;
  if (rule.rel_ci > 0) frames = std::min(frames, frames_for_width(pilot));
  if (rule.target_flr > 0) frames = std::min(frames, frames_for_target(pilot));
  return std::min(in_groups(std::max(frames, 1.0)), static_cast<double>(rule.max_frames));
}

double expected_seconds(const Pilot& pilot) {
  return expected_frames(pilot) * pilot.seconds_per_frame;
}

double expected_seconds(const std::vector<Pilot>& pilots) {
  double sum = 0;
  for (const Pilot& pilot : pilots) sum += expected_seconds(pilot);
  return sum;
}

std::uint64_t frames_within(const std::vector<Pilot>& pilots, double seconds) {
  const auto fits = [&](std::uint64_t groups) {
    std::vector<Pilot> limited = pilots;
    for (Pilot& pilot : limited) pilot.rule.max_frames = groups * group_size;
    return expected_seconds(limited) <= seconds;
  };
  std::uint64_t good = 1, bad = static_cast<std::uint64_t>(most_frames) / group_size + 1;
  while (bad - good > 1) {
    const std::uint64_t middle = good + (bad - good) / 2;
    (fits(middle) ? good : bad) = middle;
  }
  return good * group_size;
}

std::uint64_t runs_within(const std::vector<RunPilot>& pilots, double seconds, double most) {
  double setup_s = 0, run_s = 0;
  for (const RunPilot& pilot : pilots) {
    setup_s += pilot.setup_s;
    run_s += pilot.run_s;
  }
  return static_cast<std::uint64_t>(std::clamp((seconds - setup_s) / run_s, 1.0, most));
}

}  // namespace sim
