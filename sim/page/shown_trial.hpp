#pragma once
// The trial that a report shows, and its spectrum.
#include <cstdint>
#include <optional>
#include <string>

#include "channel/receiver_module.hpp"
#include "sim/picture/chart.hpp"
#include "sim/result/stored_result.hpp"
#include "sim/trace/trace.hpp"

namespace sim {

struct ShownTrial {
  TracedTrial trial;           // with taps
  channel::ModuleData module;  // of this trial
};

/// A line for who misses the trial: where trials make no waveform; else empty.
std::string why_no_trial(const Scenario& scenario);

/// Nothing where trials make no waveform, or send nothing.
std::optional<ShownTrial> trial_to_show(const StoredResult& stored, std::uint64_t point,
                                        std::uint32_t number);

/// Power spectral density before and behind the band-pass (Welch), with the module's response; of
/// matched receivers that of the light alone.
Chart spectrum_chart(const ShownTrial& shown);

}  // namespace sim
