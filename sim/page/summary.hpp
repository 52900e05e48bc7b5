#pragma once
// The answer on top of a report, in words and numbers.
#include <string>

#include "sim/page/ablations.hpp"
#include "sim/result/ranking.hpp"
#include "sim/result/result.hpp"

namespace sim {

/// What a reader came for: how far the links reach at 1 % frame loss, which of several furthest,
/// how many units carry. Empty of weighted results, and where nothing was swept.
std::string answer_of(const LinkResult& result, const Ranking& ranking);

/// A sentence a line: what is missing, how much was simulated, what the link is like where it
/// fails, what limits it there.
std::string summary_of(const LinkResult& result, const Ablations& ablations);

}  // namespace sim
