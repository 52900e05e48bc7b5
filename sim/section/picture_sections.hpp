#pragma once
// Sections of a report that are a picture with its table, and the one with the scenario.
#include <string>

#include "sim/picture/chart.hpp"
#include "sim/picture/heat_map.hpp"
#include "sim/picture/share_bars.hpp"
#include "sim/section/page_section.hpp"

namespace sim {

PageSection chart_section(Chart chart);

/// `name`: of the picture's file.
PageSection map_section(const std::string& name, const HeatMap& map);
PageSection shares_section(const std::string& name, const ShareBars& bars);

/// The text of a scenario, and the command that repeats it.
PageSection scenario_section(const std::string& command, const std::string& scenario_toml);

}  // namespace sim
