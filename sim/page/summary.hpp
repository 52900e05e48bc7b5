#pragma once
// The answer on top of a report, in words and numbers.
#include <string>

#include "sim/page/ablations.hpp"
#include "sim/result/ranking.hpp"
#include "sim/result/result.hpp"

namespace sim {

/// A sentence a line: how much was simulated, how far the link reaches at 1 % frame loss, what it
/// is like where it fails, what limits it there, what is missing.
std::string summary_of(const LinkResult& result, const Ranking& ranking,
                       const Ablations& ablations);

}  // namespace sim
