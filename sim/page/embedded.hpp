#pragma once
// Files that are built into the program (embed.cmake).
#include <string_view>

namespace sim {

extern const std::string_view report_style;
/// One block together, in which each may use what the others name.
extern const std::string_view axis_script, chart_script, trial_script, table_script, report_script;
/// uPlot 1.6 (MIT), by npm; empty where it was not there when the program was built.
extern const std::string_view uplot_script, uplot_style, uplot_license;

}  // namespace sim
