#pragma once
// What `cosys-sim parts` prints: a list of parts, or the sheet of one, as text or as JSON.
#include <string>
#include <vector>

#include "sim/report/part_sheet.hpp"

namespace sim {

/// A line a part, under a line of names.
std::string parts_table(const std::vector<PartSheet>& parts);
std::string parts_json(const std::vector<PartSheet>& parts);

std::string sheet_text(const PartSheet& sheet);
/// Values that are not known are null.
std::string sheet_json(const PartSheet& sheet);

}  // namespace sim
