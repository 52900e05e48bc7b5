#pragma once
// What is drawn for a group of trials that run together, and their pins.
#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/trial.hpp"

namespace sim {

struct TrialGroup {
  std::vector<Transmission> sent;
  std::vector<std::optional<channel::ModuleDesign>> units;
  std::vector<channel::ChainInput> inputs;  // point to the rest
};

/// Of the trials first ... first + n - 1.
TrialGroup draw_group(const Link& link, std::uint32_t first, int n);

/// Steps 3-7 of such inputs, sent[i] being what the drive of inputs[i] sends.
std::vector<dsp::LogicTrace> pins_of(const Link& link, const std::vector<const Transmission*>& sent,
                                     const std::vector<channel::ChainInput>& inputs,
                                     const std::atomic<bool>* stop, channel::StageClock* clock);

/// To each of them.
std::vector<const Transmission*> pointers(const std::vector<Transmission>& sent);

/// Adds what a trial costs.
void add_cost(GroupResult& result, const Link& link, const Transmission& sent);

}  // namespace sim
