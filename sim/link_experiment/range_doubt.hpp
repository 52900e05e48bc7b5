#pragma once
// How far a range can be trusted: where a few drawn units of the parts end, beside the parts as
// their files have them.
#include "sim/result/ranking.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/threads/parallel_runs.hpp"

namespace sim {

/// Gives the rows of a ranking their `doubt`: the ranges of 16 units, found by halving the swept
/// values, with one group of eight frames at each. Not where there is nothing to doubt: a module
/// whose numbers are all known, or whose gain control the scenario sets; units that are swept or
/// drawn already; weighted trials. Nor for more rows than anybody reads.
void add_doubts(Ranking& ranking, const LoadedScenario& scenario, const Workers& workers);

}  // namespace sim
