#pragma once
// Trials of a link whose light and module are computed as their envelope: steps 3-7 of
// sim/trial/trial.hpp are one step a carrier cycle, of messages and of as much of the dark before
// each as the module's gain needs to settle in noise. Of the rest of a pause only the release of
// the gain is computed. No samples are made, so `n_samples` is 0.
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "dsp/logic_trace.hpp"
#include "sim/trial/trial.hpp"

namespace sim {

/// The pins of trials first, first + 1, ..., as many at once as the processor has lanes for.
std::vector<dsp::LogicTrace> envelope_pins(const Link& link, std::uint32_t first,
                                           std::span<const Transmission> sent,
                                           const std::atomic<bool>* stop);

/// The pin of one trial, computed alone; the one that envelope_pins gives.
dsp::LogicTrace envelope_pin(const Link& link, std::uint32_t trial, const Transmission& sent);

}  // namespace sim
