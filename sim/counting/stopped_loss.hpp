#pragma once
// The frame loss ratio of a point that may have been stopped by a target. Such a point stops where
// chance went one way, so the lost over all frames are too far on that side, and an interval made
// for a number of frames that was fixed beforehand holds the truth too seldom.
#include <cstdint>

#include "sim/counting/statistics.hpp"
#include "sim/counting/stop_rule.hpp"

namespace sim {

/// Of `lost` of `frames`, at which `rule`, whose target is above 0, stopped or somebody interrupted
/// it: the median-unbiased estimate and the interval in which no end of counting is left out that
/// is at least as far on its side, in the stagewise order: sooner stopped above the target is more
/// loss, sooner stopped below is less (Tsiatis, Rosner & Mehta, Biometrics 40 (1984) 797-803;
/// Jennison & Turnbull, Group Sequential Methods, 2000, chapter 8). Of the rule, its width of the
/// BER's interval is passed over.
Estimate stopped_loss(const StopRule& rule, std::uint64_t frames, std::uint64_t lost, double level);

}  // namespace sim
