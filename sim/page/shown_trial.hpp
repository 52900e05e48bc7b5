#pragma once
// The trial that a report shows, and what of several is drawn beside it.
#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "channel/receiver_module.hpp"
#include "sim/picture/chart.hpp"
#include "sim/result/stored_result.hpp"
#include "sim/trace/trace.hpp"

namespace sim {

/// How much later than the light's the edges of the pin are, in microseconds.
struct EdgeDelays {
  std::vector<double> falling_us, rising_us;  // light begins, light ends
};

struct ShownTrial {
  TracedTrial trial;  // with taps
  channel::ModuleData module;
  EdgeDelays delays;
  int delays_of = 0;  // trials
};

/// The first of twenty that is misread where the link fails, or else the first of all. Nothing
/// where trials make no waveform, or are weighted. Worth nothing once `interrupt` is true.
std::optional<ShownTrial> trial_to_show(const StoredResult& stored,
                                        const std::atomic<bool>& interrupt);

/// Adds those of a trial's last message. An edge that the pin lacks, or has more than half a bit
/// away, has no delay.
void add_delays(EdgeDelays& delays, const TracedTrial& trial);

/// Power spectral density before and behind the band-pass (Welch), with the module's response.
Chart spectrum_chart(const ShownTrial& shown);
/// Histogram of the delays; empty curves where there are none.
Chart jitter_chart(const ShownTrial& shown);
/// The integrator over two bits, all bits of the message over each other, as SVG.
std::string eye_as_svg(const ShownTrial& shown);

}  // namespace sim
