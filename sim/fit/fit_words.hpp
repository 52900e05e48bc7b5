#pragma once
// Sentences and cells that terminal and page have in common.
#include <string>
#include <vector>

#include "sim/fit/fit_report.hpp"

namespace sim {

/// How much is told, how well it fits, and where the part does not follow the rule.
std::vector<std::string> answer_sentences(const MeasuredModule& measured);
/// What was read, what it does not tell, and which light would.
std::vector<std::string> further_sentences(const MeasuredModule& measured);

/// Which light Emin holds for.
std::string level_sentence(const MeasuredModule& measured);

/// Heads and rows: constant, value, interval, unit, and what the module that it is like has.
std::vector<std::string> constants_head(const MeasuredModule& measured);
std::vector<std::vector<std::string>> constants_rows(const MeasuredModule& measured);

}  // namespace sim
