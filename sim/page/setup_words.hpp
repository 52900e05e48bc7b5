#pragma once
// What a result of a link is of, in a sentence: who sends what, and who hears it from where.
#include <string>
#include <vector>

#include "sim/scenario/settings.hpp"

namespace sim {

/// Empty of a key that is not set.
std::string setting_value(const std::vector<Setting>& settings, const std::string& key);

/// What shines besides the LED: "0.6 W/m2 of ambient light", "another light (fluorescent)".
std::vector<std::string> other_lights(const std::vector<Setting>& settings);

/// "TSOP4856 hears ...", a line; of swept keys their values. Of links that are given an Eb/N0 the
/// light and the geometry, which do not count, are left out.
std::string setup_words(const std::vector<Setting>& settings);

}  // namespace sim
