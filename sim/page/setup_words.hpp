#pragma once
// What a result of a link is of, in a sentence: who sends what, and who hears it from where.
#include <string>
#include <vector>

#include "sim/scenario/settings.hpp"

namespace sim {

/// "TSOP4856 hears ...", a line; of swept keys their values. Of links that are given an Eb/N0 the
/// light and the geometry, which do not count, are left out.
std::string setup_words(const std::vector<Setting>& settings);

}  // namespace sim
