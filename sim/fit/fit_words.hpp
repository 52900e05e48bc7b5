#pragma once
// Sentences and cells that terminal and page have in common.
#include <string>
#include <vector>

#include "sim/fit/fit_report.hpp"

namespace sim {

/// What was read, how well it fits, what it does not tell, and where the part is another.
std::vector<std::string> fit_sentences(const MeasuredModule& measured);

/// Heads and rows: constant, value, interval, unit, and what the module that it is like has.
std::vector<std::string> constants_head(const MeasuredModule& measured);
std::vector<std::vector<std::string>> constants_rows(const MeasuredModule& measured);

}  // namespace sim
