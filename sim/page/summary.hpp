#pragma once
// The answer on top of a report, in words and numbers.
#include <string>

#include "sim/page/ablations.hpp"
#include "sim/result/ranking.hpp"
#include "sim/result/result.hpp"

namespace sim {

/// What a reader came for, behind what is missing of a run that was stopped: how far the links
/// reach at 1 % frame loss, which of several furthest, how many units carry. There is no answer of
/// weighted results, nor where nothing was swept.
std::string answer_of(const LinkResult& result, const Ranking& ranking);

/// A sentence a line: how much was simulated, what the link is like where it fails, what limits it
/// there.
std::string summary_of(const LinkResult& result, const Ablations& ablations);

}  // namespace sim
