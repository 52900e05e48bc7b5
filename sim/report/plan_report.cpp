#include "sim/report/plan_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/columns/text_table.hpp"
#include "sim/scenario/experiment_kind.hpp"
#include "sim/scenario/sweep.hpp"

namespace sim {

namespace {

/// Fewer than all where somebody interrupted it.
std::string points_planned(std::size_t planned, std::size_t all) {
  if (planned < all) return fmt::format("unfinished: {} of {} points", planned, all);
  return fmt::format("{} point{}", planned, planned == 1 ? "" : "s");
}

}  // namespace

std::string duration_text(double seconds) {
  constexpr double minute = 60, hour = 60 * minute, day = 24 * hour;
  if (seconds < 9.95) return fmt::format("{:.2g} s", seconds);
  if (seconds < minute - 0.5) return fmt::format("{:.0f} s", seconds);
  if (seconds < hour - 0.5)
    return fmt::format("{} min {} s", std::lround(seconds) / 60, std::lround(seconds) % 60);
  const long minutes = std::lround(seconds / minute);
  if (seconds < 2 * day) return fmt::format("{} h {} min", minutes / 60, minutes % 60);
  return fmt::format("{:.0f} days", seconds / day);
}

std::string plan_table(const LoadedScenario& scenario, const std::vector<RunPilot>& pilots,
                       int threads) {
  const std::string unit = amount_unit(scenario.base);
  const bool may_stop =
      std::ranges::any_of(pilots, [](const RunPilot& pilot) { return may_stop_early(pilot); });
  std::vector<TextColumn> columns = axis_columns(scenario.sweep);
  columns.push_back({{"", may_stop ? unit : "", may_stop ? "at most" : unit}, number_width});
  if (may_stop) columns.push_back({{"", unit, "expected"}, number_width});
  columns.push_back({{"", "", "time"}, number_width});
  std::string text = table_head(columns);
  double runs = 0;
  for (const RunPilot& pilot : pilots) {
    std::vector<std::string> texts = coordinate_texts(scenario.sweep, pilot.coordinates);
    texts.push_back(std::to_string(pilot.runs));
    if (may_stop) texts.push_back(fmt::format("{:.0f}", expected_runs(pilot)));
    texts.push_back(duration_text(expected_seconds(pilot)));
    text += table_line(columns, texts);
    runs += expected_runs(pilot);
  }
  return text + fmt::format("{}: {}{:.0f} {}, {} on {} threads\n",
                            points_planned(pilots.size(), count_points(scenario.sweep)),
                            may_stop ? "about " : "", runs, unit,
                            duration_text(expected_seconds(pilots)), threads);
}

}  // namespace sim
