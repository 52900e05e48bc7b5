#include "sim/link_experiment/range_doubt.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "sim/components/drawn_part.hpp"
#include "sim/link/link.hpp"
#include "sim/loading/fidelity_check.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/result/unit_range.hpp"
#include "sim/scenario/method.hpp"
#include "sim/trial/trial.hpp"

namespace sim {
namespace {

constexpr std::uint32_t n_units = 16;
constexpr std::size_t most_rows = 40;
constexpr int frames_a_point = 8;  // as many as cost one

bool is_doubted(const LoadedScenario& scenario) {
  const auto is_given = [&](const char* key) { return scenario.places.contains(key); };
  return !is_given("module.agc_attack_db_per_ms") && !is_given("receiver.unit") &&
         !is_given("receiver.population") &&
         method_of(scenario.base.simulation) == Method::brute_force;
}

bool is_unclear(const RowCrossing& row) {
  return row.crossing.kind == Crossing::Kind::not_monotone ||
         row.crossing.kind == Crossing::Kind::unclear;
}

/// A line of the sweep along its range.
class RangeLine {
 public:
  RangeLine(const LoadedScenario& scenario, const Ranking& ranking, const RowCrossing& row)
      : scenario_(scenario),
        ranking_(ranking),
        row_(row),
        axis_(in_rising_order(scenario.sweep[ranking.abscissa])),
        from_above_(known_direction(axis_.key).value_or(false)) {}

  const Axis& axis() const { return axis_; }
  bool from_above() const { return from_above_; }

  /// The place of the module in it, as its file has it.
  channel::ModuleData module() const { return at(0, 0).module; }

  UnitRange range_of(std::uint32_t unit, const std::atomic<bool>* stop) const {
    const std::size_t n = axis().values.size();
    std::size_t carried = 0, end = n;  // values from the good end
    while (carried < end && !is_stopped(stop)) {
      const std::size_t middle = carried + (end - carried) / 2;
      if (carries(at(from_above_ ? n - 1 - middle : middle, unit), stop))
        carried = middle + 1;
      else
        end = middle;
    }
    return range_carried(axis_, carried, from_above_);
  }

 private:
  /// Unit 0: the parts as their files have them.
  Scenario at(std::size_t value, std::uint32_t unit) const {
    std::vector<double> coordinates(scenario_.sweep.size());
    coordinates[ranking_.abscissa] = axis().values[value];
    for (std::size_t i = 0; i < ranking_.others.size(); ++i)
      coordinates[ranking_.others[i]] = row_.others[i];
    Scenario scenario = point_scenario(scenario_, coordinates);
    scenario.receiver.unit = unit;
    place_unit(scenario);
    return scenario;
  }

  /// Whether no frame of a few is lost.
  static bool carries(Scenario scenario, const std::atomic<bool>* stop) {
    choose_fast_fidelity(scenario);
    const Link link = make_link(scenario);
    return run_group(link, 0, frames_a_point, stop).tally.n_frames_lost == 0;
  }

  const LoadedScenario& scenario_;
  const Ranking& ranking_;
  const RowCrossing& row_;
  Axis axis_;
  bool from_above_;
};

std::vector<UnitRange> ranges_of(const RangeLine& line, const Workers& workers) {
  const SharedRuns units{.runs = n_units, .most_at_once = 1, .workers = workers, .first = 1};
  return ParallelRuns<UnitRange>(units,
                                 [&](std::uint32_t unit, int, const std::atomic<bool>* over) {
                                   return line.range_of(unit, over);
                                 })();
}

}  // namespace

void add_doubts(Ranking& ranking, const LoadedScenario& scenario, const Workers& workers) {
  if (!is_doubted(scenario) || ranking.rows.empty() || ranking.rows.size() > most_rows) return;
  if (!known_direction(scenario.sweep[ranking.abscissa].key)) return;
  for (RowCrossing& row : ranking.rows) {
    const RangeLine line(scenario, ranking, row);
    const channel::ModuleData module = line.module();
    if (module.bounds.empty() || line.axis().values.size() < 2 || is_unclear(row)) continue;
    std::vector<UnitRange> ranges = ranges_of(line, workers);
    if (workers.interrupted()) return;
    row.doubt =
        RangeDoubt{module.name, n_units, range_quantiles(std::move(ranges), line.from_above()),
                   std::ranges::any_of(module.bounds, &channel::NumberBounds::is_measured),
                   std::ranges::any_of(module.bounds, &channel::NumberBounds::breaks_rule)};
  }
}

}  // namespace sim
