#include "sim/page/omissions.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/counting/statistics.hpp"
#include "sim/engine/experiment.hpp"
#include "sim/loading/load_scenario.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/page/frame_statistics.hpp"
#include "sim/report/text_table.hpp"
#include "sim/result/curve_fit.hpp"
#include "sim/result/ranking.hpp"
#include "sim/result/unfinished.hpp"

namespace sim {
namespace {

constexpr std::uint64_t most_frames = 100;
constexpr double most_samples = 2e8;  // without one trouble

struct Trouble {
  std::string name;
  std::vector<std::string> overrides;  // that take it away
};

bool is_on(const AmbientSettings& ambient) {
  return ambient.irradiance_w_per_m2 + ambient.daylight_lux + ambient.tungsten_lux > 0;
}

bool has_wrong_clock(const Scenario& s) {
  return s.device.clock_error_ppm != 0 || s.uart.clock_error_ppm != 0 ||
         s.device.start_jitter_us > 0;
}

std::vector<Trouble> troubles_of(const Scenario& s) {
  std::vector<Trouble> troubles;
  const auto add = [&](bool is_there, std::string name, std::vector<std::string> overrides) {
    if (is_there) troubles.push_back({std::move(name), std::move(overrides)});
  };
  add(s.noise.scale > 0, "noise", {"noise.scale=0"});
  add(s.module.agc_attack_db_per_ms > 0, "the module's automatic gain control",
      {"module.agc_attack_db_per_ms=0"});
  add(is_on(s.ambient), "ambient light",
      {"ambient.irradiance_w_per_m2=0", "ambient.daylight_lux=0", "ambient.tungsten_lux=0"});
  add(has_wrong_clock(s), "errors of the clocks",
      {"device.clock_error_ppm=0", "uart.clock_error_ppm=0", "device.start_jitter_us=0"});
  add(s.device.carrier_error_ppm != 0, "the carrier's error", {"device.carrier_error_ppm=0"});
  add(s.receiver.supply_ripple_mv > 0, "ripple on the supply", {"receiver.supply_ripple_mv=0"});
  for (const auto& [name, settings] : s.disturbances)
    add(true, fmt::format("the disturbance {} ({})", name, settings.kind),
        {fmt::format("disturbance.{}.irradiance_w_per_m2=0", name)});
  return troubles;
}

/// Overrides that make one point of a sweep.
std::vector<std::string> pinned(const ExperimentResult& result, const PointResult& point,
                                std::uint64_t frames) {
  std::vector<std::string> overrides{fmt::format("stop.max_frames={}", frames),
                                     "stop.max_frame_errors=0", "stop.rel_ci=0",
                                     "stop.target_flr=0"};
  for (std::size_t i = 0; i < result.axes.size(); ++i) {
    const Axis& axis = result.axes[i];
    overrides.push_back(
        axis.is_text() ? fmt::format("{}={}", axis.key, coordinate_text(axis, point.coordinates[i]))
                       : fmt::format("{}={}", axis.key, point.coordinates[i]));
  }
  return overrides;
}

/// Whether a point is of the link that comes first; all are where there is no ranking.
bool is_of_first(const PointResult& point, const Ranking& ranking) {
  for (std::size_t i = 0; i < ranking.others.size(); ++i)
    if (point.coordinates[ranking.others[i]] != ranking.rows.front().others[i]) return false;
  return true;
}

const PointResult* nearest_to_half(const ExperimentResult& result, const Ranking& ranking) {
  constexpr double half = 0.5;
  const PointResult* found = nullptr;
  double least = 0;
  for (const PointResult& point : result.points) {
    if (!measured(point) || !is_of_first(point, ranking)) continue;
    const double loss = frame_loss_ratio(point.tally, result.ci_level).value;
    const bool nearer = loss >= half ? least < half || loss < least : loss > least && least < half;
    if (loss > 0 && nearer) found = &point, least = loss;
  }
  return found;
}

}  // namespace

const PointResult* failing_point(const ExperimentResult& result) {
  const Ranking ranking = rank(result);
  if (ranking.best_first && !ranking.rows.empty())
    if (const PointResult* best = nearest_to_half(result, ranking)) return best;
  return nearest_to_half(result, {});
}

Omissions leave_out(const LoadedScenario& scenario, const ExperimentResult& result,
                    const Workers& workers) {
  const PointResult* point = failing_point(result);
  if (point == nullptr || has_theory(scenario) || is_weighted(result)) return {};
  const Link link = make_link(point_scenario(scenario, point->coordinates));
  const std::vector<std::string> pins =
      pinned(result, *point, std::min(most_frames, affordable_trials(link, most_samples)));
  const auto load = [&](const std::vector<std::string>& without) {
    std::vector<std::string> overrides = pins;
    overrides.insert(overrides.end(), without.begin(), without.end());
    return parse_scenario(scenario.text, scenario.path, overrides, {});
  };
  const auto tally_of = [&](const LoadedScenario& changed) {
    return run_experiment(changed, unfinished(changed, ""),
                          {.threads = workers.threads, .interrupt = workers.interrupt})
        .points.front()
        .tally;
  };
  const LoadedScenario whole = load({});
  Omissions found{place_text(result.axes, point->coordinates), {{"", tally_of(whole)}}};
  for (const Trouble& trouble : troubles_of(whole.base)) {
    if (workers.interrupted()) break;
    found.omissions.push_back({trouble.name, tally_of(load(trouble.overrides))});
  }
  return found;
}

std::vector<std::string> limits_of(const Omissions& omissions) {
  constexpr double level = 0.95;
  std::vector<std::string> limits;
  for (const Omission& o : omissions.omissions)
    if (!o.without.empty() && frame_loss_ratio(o.tally, level).high <
                                  frame_loss_ratio(omissions.omissions.front().tally, level).low)
      limits.push_back(o.without);
  return limits;
}

}  // namespace sim
