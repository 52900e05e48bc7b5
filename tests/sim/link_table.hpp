#pragma once
// The terminal's table of a link's points, for tests of what is in it.
#include <string>
#include <vector>

#include "scenarios.hpp"
#include "sim/columns/columns_table.hpp"
#include "sim/link_experiment/link_columns.hpp"

namespace sim {

inline PointTable<LinkPoint> link_table(const std::vector<Axis>& axes, bool theory = false) {
  LoadedScenario scenario =
      loaded("", {theory ? "receiver.module=ideal-coherent" : "receiver.module=TSOP4856"});
  scenario.sweep = axes;
  return {link_columns(), scenario, {}};
}

inline std::string link_row(const LinkPoint& point, const std::vector<Axis>& axes = {}) {
  return link_table(axes).row(point);
}

}  // namespace sim
