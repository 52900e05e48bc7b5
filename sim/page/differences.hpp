#pragma once
// In what the results of a page differ: keys of their scenarios.
#include <vector>

#include "sim/page/report_part.hpp"

namespace sim {

/// A row for each key that not all set alike, "-" where a scenario has no such key or leaves it
/// empty; a column for each part.
PageSection differences_section(const std::vector<ReportPart>& parts);

}  // namespace sim
