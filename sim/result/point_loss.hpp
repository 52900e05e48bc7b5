#pragma once
// The frame loss of a point as it is printed. Where a target may have stopped it, that is not the
// lost over all frames.
#include "sim/counting/statistics.hpp"
#include "sim/result/result.hpp"

namespace sim {

/// Whether the point's rule has a target; of weighted trials none has.
bool may_stop_by_target(const LinkPoint& point);

/// Then median-unbiased, with an interval that allows for the stop (sim/counting/stopped_loss.hpp);
/// NaN where nothing was counted.
Estimate frame_loss_of(const LinkPoint& point, double level);

}  // namespace sim
