#pragma once
// Sanity alarms: what a point's counts, or a row of points, should make the user distrust. Other
// than the limits of validity (sim/link/validity.hpp) they look at what came out.
#include <cstdint>
#include <span>

#include "sim/result/ranking.hpp"
#include "sim/result/result.hpp"

namespace sim {

/// Bit i of a point's alarms is row i of the table.
struct Alarm {
  const char* name;                  // as the table and the result file call it
  const char* meaning;               // one line
  bool (*raised)(const LinkPoint&);  // by the point itself; null: by the row that it is in
};

std::span<const Alarm> alarms();

/// Those that a point raises by itself.
std::uint64_t own_alarms(const LinkPoint& point);

/// Adds, at all its points, the one of a row across the grid along which the loss goes up and down.
void add_row_alarms(LinkResult& result, const CrossingQuestion& question = {});

}  // namespace sim
