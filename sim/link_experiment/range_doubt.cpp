#include "sim/link_experiment/range_doubt.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/columns/unit_spread_text.hpp"
#include "sim/components/drawn_part.hpp"
#include "sim/link/link.hpp"
#include "sim/loading/fidelity_check.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/result/unit_spread.hpp"
#include "sim/scenario/method.hpp"
#include "sim/trial/trial.hpp"

namespace sim {
namespace {

constexpr std::uint32_t n_units = 16;
constexpr std::size_t most_rows = 40;
constexpr int frames_a_point = 8;  // as many as cost one

bool is_doubted(const LoadedScenario& scenario) {
  const ReceiverSettings& receiver = scenario.base.receiver;
  return !scenario.places.contains("module.agc_attack_db_per_ms") &&
         !scenario.places.contains("receiver.unit") && receiver.population == 0 &&
         method_of(scenario.base.simulation) == Method::brute_force;
}

/// A line of the sweep along its range.
class RangeLine {
 public:
  RangeLine(const LoadedScenario& scenario, const Ranking& ranking, const RowCrossing& row)
      : scenario_(scenario), ranking_(ranking), row_(row) {}

  const Axis& axis() const { return scenario_.sweep[ranking_.abscissa]; }

  /// The place of the module in it, as its file has it.
  channel::ModuleData module() const { return at(0, 0).module; }

  UnitRange range_of(std::uint32_t unit, const std::atomic<bool>* stop) const {
    const std::size_t n = axis().values.size();
    std::size_t carried = 0, end = n;  // values from the good end
    while (carried < end && !is_stopped(stop)) {
      const std::size_t middle = carried + (end - carried) / 2;
      if (carries(at(ranking_.more_is_better ? n - 1 - middle : middle, unit), stop))
        carried = middle + 1;
      else
        end = middle;
    }
    return range_carried(axis(), carried, ranking_.more_is_better);
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
  if (!is_doubted(scenario) || ranking.rows.size() > most_rows) return;
  for (RowCrossing& row : ranking.rows) {
    const RangeLine line(scenario, ranking, row);
    const channel::ModuleData module = line.module();
    if (module.bounds.empty() || line.axis().values.size() < 2) continue;
    std::vector<UnitRange> ranges = ranges_of(line, workers);
    if (workers.interrupted()) return;
    row.doubt = doubt_words(line.axis(), range_quantiles(std::move(ranges), ranking.more_is_better),
                            n_units, module.name);
  }
}

}  // namespace sim
