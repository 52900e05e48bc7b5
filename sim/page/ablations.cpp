#include "sim/page/ablations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "sim/counting/statistics.hpp"
#include "sim/failure.hpp"
#include "sim/link_experiment/link_columns.hpp"
#include "sim/link_experiment/link_measurement.hpp"
#include "sim/loading/load_scenario.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/page/frame_statistics.hpp"
#include "sim/result/place_text.hpp"
#include "sim/result/ranking.hpp"
#include "sim/scenario/disturbance_keys.hpp"

namespace sim {
namespace {

constexpr std::uint64_t most_frames = 100;
constexpr std::uint64_t frames_a_value = 20;   // in looking for half the loss
constexpr std::uint64_t fewest_for_half = 50;  // affordable ones: else it takes too long
constexpr double most_samples = 2e8;           // without one trouble

struct Trouble {
  std::string change;                  // "without noise"
  std::vector<std::string> overrides;  // that make it
};

bool is_on(const AmbientSettings& ambient) {
  return ambient.irradiance_w_per_m2 + ambient.daylight_lux + ambient.tungsten_lux > 0;
}

bool has_wrong_clock(const Scenario& s) {
  return s.device.clock_error_ppm != 0 || s.uart.clock_error_ppm != 0 ||
         s.device.start_jitter_us > 0;
}

/// A unit's threshold is half of its own: without a greatest one it is not drawn again.
std::vector<std::string> half_the_threshold(const Scenario& s) {
  std::vector<std::string> changes{
      fmt::format("module.emin_mw_per_m2={}", s.module.emin_mw_per_m2 / 2)};
  if (s.receiver.unit != 0) changes.emplace_back("module.emin_max_mw_per_m2=0");
  return changes;
}

std::vector<Trouble> troubles_of(const Scenario& s) {
  std::vector<Trouble> troubles;
  const auto add = [&](bool is_there, std::string change, std::vector<std::string> overrides) {
    if (is_there) troubles.push_back({std::move(change), std::move(overrides)});
  };
  add(s.noise.scale > 0, "without noise", {"noise.scale=0"});
  add(s.module.agc_attack_db_per_ms > 0, "without the module's automatic gain control",
      {"module.agc_attack_db_per_ms=0"});
  add(s.module.emin_mw_per_m2 > 0, "with half of the module's threshold", half_the_threshold(s));
  add(is_on(s.ambient), "without ambient light",
      {"ambient.irradiance_w_per_m2=0", "ambient.daylight_lux=0", "ambient.tungsten_lux=0"});
  add(has_wrong_clock(s), "without errors of the clocks",
      {"device.clock_error_ppm=0", "uart.clock_error_ppm=0", "device.start_jitter_us=0"});
  add(s.device.carrier_error_ppm != 0, "without the carrier's error",
      {"device.carrier_error_ppm=0"});
  add(s.receiver.supply_ripple_mv > 0, "without ripple on the supply",
      {"receiver.supply_ripple_mv=0"});
  for (const auto& [name, settings] : s.disturbances)
    add(true, fmt::format("without the disturbance {} ({})", name, settings.kind),
        {fmt::format("disturbance.{}.{}=0", name, kind_of(settings).numbers.front().facts.name)});
  return troubles;
}

/// One point of a sweep, run again with changes.
class Rerun {
 public:
  Rerun(const LoadedScenario& scenario, const LinkResult& result, const LinkPoint& point,
        const Workers& workers)
      : scenario_(scenario), workers_(workers) {
    for (std::size_t i = 0; i < result.axes.size(); ++i) {
      const Axis& axis = result.axes[i];
      point_.push_back(fmt::format("{}={}", axis.key,
                                   axis.is_text() ? coordinate_text(axis, point.coordinates[i])
                                                  : fmt::format("{}", point.coordinates[i])));
    }
  }

  LoadedScenario load(std::vector<std::string> changes = {}) const {
    changes.insert(changes.begin(), point_.begin(), point_.end());
    return parse_scenario(scenario_.text, scenario_.path, changes, {});
  }

  /// Nothing where keys do not go together after the changes, as below what a fidelity can do.
  std::optional<Tally> tally(std::uint64_t frames, std::vector<std::string> changes) const {
    changes.insert(changes.end(),
                   {fmt::format("stop.max_frames={}", frames), "stop.max_frame_errors=0",
                    "stop.rel_ci=0", "stop.target_flr=0"});
    try {
      const LoadedScenario changed = load(std::move(changes));
      return run_link(changed, workers_).points.front().tally;
    } catch (const Failure& failure) {
      if (failure.code() == ExitCode::bad_input) return std::nullopt;
      throw;
    }
  }

 private:
  const LoadedScenario& scenario_;
  const Workers& workers_;
  std::vector<std::string> point_;  // the overrides that make it
};

/// Whether a point is of the link that comes first; all are where there is no ranking.
bool is_of_first(const LinkPoint& point, const Ranking& ranking) {
  for (std::size_t i = 0; i < ranking.others.size(); ++i)
    if (point.coordinates[ranking.others[i]] != ranking.rows.front().others[i]) return false;
  return true;
}

const LinkPoint* nearest_to_half(const LinkResult& result, const Ranking& ranking) {
  constexpr double half = 0.5;
  const LinkPoint* found = nullptr;
  double least = 0;
  for (const LinkPoint& point : result.points) {
    if (!point.reached() || !is_of_first(point, ranking)) continue;
    const double loss = frame_loss_ratio(point.tally, LinkResult::ci_level).value;
    const bool nearer = loss >= half ? least < half || loss < least : loss > least && least < half;
    if (loss > 0 && nearer) found = &point, least = loss;
  }
  return found;
}

/// Whether it is known that the loss only rises or only falls along the ranking's axis, whose
/// values have logarithms and may lie between those of the sweep.
bool goes_one_way(const Ranking& ranking, const LinkResult& result, const LinkPoint& point) {
  using Kind = Crossing::Kind;
  if (ranking.rows.empty() || point.coordinates[ranking.abscissa] <= 0) return false;
  const Axis& axis = result.axes[ranking.abscissa];
  if (find_key(axis.key)->facts.type != KeyType::number) return false;
  const auto count = [&](std::initializer_list<Kind> kinds) {
    return std::ranges::count_if(ranking.rows, [&](const RowCrossing& row) {
      return std::ranges::find(kinds, row.crossing.kind) != kinds.end();
    });
  };
  const bool is_known =
      axis.key == distance_key || count({Kind::fitted, Kind::jump, Kind::bracketed}) > 0;
  return is_known && count({Kind::not_monotone, Kind::unclear}) == 0;
}

/// Along its own key nothing can be left out.
bool sets(const Trouble& trouble, const std::string& key) {
  return std::ranges::any_of(trouble.overrides,
                             [&](const std::string& each) { return each.starts_with(key + "="); });
}

bool loses_half(const Tally& tally) { return 2 * tally.n_frames_lost >= tally.n_frames; }

HalfLoss half_loss_of(const Rerun& rerun, const Trouble& trouble, const Axis& along,
                      const HalfLossSearch& search) {
  const auto loses_half_at = [&](double value) -> std::optional<bool> {
    std::vector<std::string> changes = trouble.overrides;
    changes.push_back(fmt::format("{}={}", along.key, value));
    const std::optional<Tally> tally = rerun.tally(frames_a_value, std::move(changes));
    if (!tally) return std::nullopt;
    return loses_half(*tally);
  };
  return find_half_loss(loses_half_at, search);
}

}  // namespace

const LinkPoint* failing_point(const LinkResult& result) {
  const Ranking ranking = rank(result);
  if (ranking.best_first && !ranking.rows.empty())
    if (const LinkPoint* best = nearest_to_half(result, ranking)) return best;
  return nearest_to_half(result, {});
}

Ablations ablate(const LoadedScenario& scenario, const LinkResult& result, const Workers& workers) {
  const LinkPoint* point = failing_point(result);
  if (point == nullptr || has_theory(scenario) || is_weighted(result)) return {};
  const Rerun rerun(scenario, result, *point, workers);
  const LoadedScenario whole = rerun.load();
  const std::uint64_t affordable = affordable_trials(make_link(whole.base), most_samples);
  std::vector<Trouble> troubles = troubles_of(whole.base);
  troubles.insert(troubles.begin(), Trouble{});
  const Ranking ranking = rank(result);
  const bool seek_half = affordable >= fewest_for_half && goes_one_way(ranking, result, *point);
  Ablations found{place_text(result.axes, point->coordinates), {}};
  if (seek_half) found.along = result.axes[ranking.abscissa];
  for (const Trouble& trouble : troubles) {
    if (workers.interrupted()) break;
    const auto tally = rerun.tally(std::min(most_frames, affordable), trouble.overrides);
    if (!tally && trouble.change.empty()) return {};
    if (!tally) continue;
    found.ablations.push_back({trouble.change, *tally});
    if (seek_half && !sets(trouble, found.along->key))
      found.ablations.back().half =
          half_loss_of(rerun, trouble, *found.along,
                       {.begin = point->coordinates[ranking.abscissa],
                        .begin_loses = loses_half(*tally),
                        .allowed = find_key(found.along->key)->facts.range,
                        .more_is_better = ranking.more_is_better});
  }
  return found;
}

std::vector<Ablation> limits_of(const Ablations& ablations) {
  constexpr double level = 0.95;
  std::vector<Ablation> limits;
  for (const Ablation& o : ablations.ablations)
    if (!o.change.empty() && frame_loss_ratio(o.tally, level).high <
                                 frame_loss_ratio(ablations.ablations.front().tally, level).low)
      limits.push_back(o);
  const auto gain = [&](const Ablation& o) {
    return o.half ? std::abs(std::log(o.half->at / ablations.ablations.front().half->at)) : 0;
  };
  std::ranges::stable_sort(limits, std::greater<>(), gain);
  return limits;
}

std::string half_loss_text(const HalfLoss& half) {
  const char* const sides[] = {"", "beyond ", "short of "};
  const double two_digits = std::stod(fmt::format("{:.1e}", half.at));
  return fmt::format("{}{:g}", sides[static_cast<std::size_t>(half.kind)], two_digits);
}

}  // namespace sim
