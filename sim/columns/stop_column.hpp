#pragma once
// Why a point has no more runs: a column of all experiments.
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/columns/column.hpp"
#include "sim/counting/stop_rule.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

/// The names of stop_reason_names(), but that all runs were done, which are not frames.
std::vector<std::string> run_stop_names();

/// Whether rel_ci or target_flr is set at any point.
bool has_ratio_rule(const LoadedScenario& scenario);

/// Adds the column of the reasons, which each point has as `stop`.
template <class Point>
Column<Point>& add_stop_reason(Columns<Point>& columns, std::vector<std::string> names) {
  return columns.choice(
      {"stop_reason", "1", "why the point stopped"},
      [](const Point& p) -> std::optional<std::size_t> {
        if (!p.reached()) return std::nullopt;
        return static_cast<std::size_t>(p.stop);
      },
      std::move(names));
}

/// The same of an experiment of runs, with a place in the table where a rule is set.
template <class Point>
void add_stop_reason(Columns<Point>& columns) {
  add_stop_reason(columns, run_stop_names())
      .headed({{"", "", "stopped by"}, -10})
      .shown_if(has_ratio_rule);
}

}  // namespace sim
