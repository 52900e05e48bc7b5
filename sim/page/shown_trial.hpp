#pragma once
// The trial that a report shows, and what of several is drawn beside it.
#include <array>
#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "channel/receiver_module.hpp"
#include "sim/picture/chart.hpp"
#include "sim/picture/heat_map.hpp"
#include "sim/result/stored_result.hpp"
#include "sim/trace/trace.hpp"

namespace sim {

/// How much later than the light's the edges of the pin are, in microseconds.
struct EdgeDelays {
  std::vector<double> falling_us, rising_us;  // light begins, light ends
};

/// Where bits of the last message are wrong at the pin, in the middle of their slots. Messages of a
/// scenario are all the same.
struct WrongBits {
  std::vector<std::string> characters;      // as sent
  std::vector<std::array<int, 10>> counts;  // of each, by the slot: start bit, 0 to 7, stop bit
  std::vector<int> bursts;                  // [n]: how often n + 1 followed each other
};

struct ShownTrial {
  TracedTrial trial;  // with taps
  channel::ModuleData module;
  int trials = 0;  // looked at for what follows
  EdgeDelays delays{};
  WrongBits wrong{};
};

/// The first of twenty that is misread where the link fails, or else the first of all. Nothing
/// where trials make no waveform, or are weighted. Worth nothing once `interrupt` is true.
std::optional<ShownTrial> trial_to_show(const StoredResult& stored,
                                        const std::atomic<bool>& interrupt);

/// Adds those of a trial's last message. An edge that the pin lacks, or has more than half a bit
/// away, has no delay.
void add_delays(EdgeDelays& delays, const TracedTrial& trial);

void add_wrong_bits(WrongBits& wrong, const TracedTrial& trial, dsp::Seconds delay);

/// Share of wrong bits by character and slot.
HeatMap wrong_bits_map(const ShownTrial& shown);
/// How often so many wrong bits followed each other.
Chart burst_chart(const ShownTrial& shown);
/// Power spectral density before and behind the band-pass (Welch), with the module's response.
Chart spectrum_chart(const ShownTrial& shown);
/// Histogram of the delays; empty curves where there are none.
Chart jitter_chart(const ShownTrial& shown);
/// The integrator over two bits, all bits of the message over each other, as SVG.
std::string eye_as_svg(const ShownTrial& shown);

}  // namespace sim
