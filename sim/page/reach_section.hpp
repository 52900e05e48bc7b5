#pragma once
// How far each of several links reaches, as a table.
#include "sim/page/page.hpp"
#include "sim/result/ranking.hpp"

namespace sim {

/// A row for each of the ranking's, which are at least one, in its order.
PageSection reach_section(const ExperimentResult& result, const Ranking& ranking);

}  // namespace sim
