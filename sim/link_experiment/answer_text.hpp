#pragma once
// The answer of a sweep of links in one sentence: which reaches furthest, which comes next, and
// which is last.
#include <string>

#include "sim/result/ranking.hpp"

namespace sim {

/// "TSOP4856", "TSOP4856, led.current_ma = 20 mA": which link a row is.
std::string link_words(const LinkResult& result, const Ranking& ranking, const RowCrossing& row);

/// A sentence with its full stop and newline. Empty where there are not several links, or of none
/// is told how far it reaches.
std::string answer_sentence(const LinkResult& result, const Ranking& ranking);

}  // namespace sim
