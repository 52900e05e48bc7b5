#pragma once
// Crossings in words, with the digits that their intervals support.
#include <string>

#include "sim/result/curve_fit.hpp"
#include "sim/result/unit_range.hpp"

namespace sim {

/// "frame loss crosses 1 % at receiver.range_m = 7.88 [7.60, 8.20] m"
std::string crossing_sentence(const Axis& axis, const Crossing& crossing, double level = 0.01);

/// The same of a link that reaches so far, the axis being its distance: "the link reaches 7.88
/// [7.60, 8.20] m at 1 % frame loss".
std::string reach_sentence(const Axis& axis, const Crossing& crossing, double level = 0.01);

/// The same in few words, for a list whose head says the rest: "7.88 [7.60, 8.20] m".
std::string crossing_words(const Axis& axis, const Crossing& crossing, bool more_is_better);

/// The same in a sentence, without its interval: "2.15 to 2.2 m", "more than 10 m".
std::string short_crossing_words(const Axis& axis, const Crossing& crossing, bool more_is_better);

/// What a list says beside the crossing: "18 % possible", "too few frames"; often nothing.
std::string crossing_note(const Crossing& crossing, double level = 0.01);

/// Where a unit ends: "beyond 10 m", "3 to 5 m", "below 0.5 m".
std::string range_words(const Axis& axis, const UnitRange& range);

/// Where most units end: "0.5 m to beyond 10 m".
std::string span_words(const Axis& axis, const RangeQuantiles& quantiles);

}  // namespace sim
