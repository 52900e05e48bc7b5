#pragma once
// How far links reach, be they of one result or of several: in a line and as a table.
#include <cstddef>
#include <string>
#include <vector>

#include "sim/section/report_section.hpp"

namespace sim {

/// "How far each reaches", of one link "How far it reaches"; along a key that is no distance more
/// is not farther.
std::string link_range_heading(const std::string& along, std::size_t links);

/// A line: of a few links how far each reaches, of more the two ends of their order. At least one,
/// all along one key.
std::string link_range_line(const std::vector<LinkRange>& ranges);

/// The same as a table, best first.
PageSection link_range_section(std::vector<LinkRange> ranges);

}  // namespace sim
