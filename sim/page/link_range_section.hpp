#pragma once
// How far each link of a result reaches.
#include <vector>

#include "sim/page/link_range.hpp"
#include "sim/result/ranking.hpp"

namespace sim {

/// One for each of the ranking's rows, in its order.
std::vector<LinkRange> link_ranges_of(const LinkResult& result, const Ranking& ranking);

/// A bar a link, and a table with a column for each swept key; at least one row.
PageSection link_range_section(const LinkResult& result, const Ranking& ranking);

}  // namespace sim
