#pragma once
// Pictures of where the frames of one point go wrong.
#include <string>

#include "sim/page/frame_statistics.hpp"
#include "sim/page/page.hpp"
#include "sim/picture/chart.hpp"
#include "sim/picture/heat_map.hpp"

namespace sim {

/// Share of wrong bits by character and slot.
HeatMap wrong_bits_map(const FrameStatistics& frames);
/// The same by the time since the message began: what the gain control, which settles, costs.
Chart settling_chart(const FrameStatistics& frames);
/// How often so many wrong bits followed each other; some must have been wrong. Where none
/// followed another that is said, and nothing is drawn.
PageSection bursts_section(const FrameStatistics& frames);
/// What the delays come to: of which pulses are too long at the pin, and their jitter. There are
/// to be some of both edges.
std::string delays_text(const FrameStatistics& frames);
/// Histogram of the delays; empty curves where there are none.
Chart jitter_chart(const FrameStatistics& frames);

}  // namespace sim
