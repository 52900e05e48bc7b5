#pragma once
// What is drawn for trials that run together, and their pins; and which of them are a group of
// eight.
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/trial/trial.hpp"

namespace sim {

struct DrawnTrials {
  std::vector<Transmission> sent;
  std::vector<std::optional<channel::ModuleDesign>> units;
  std::vector<channel::ChainInput> inputs;  // point to the rest
};

/// Of the trials first ... first + n - 1.
DrawnTrials draw_trials(const Link& link, std::uint32_t first, int n);

/// The same of trials from `first` on that send this.
DrawnTrials draw_trials(const Link& link, std::uint32_t first, std::vector<Transmission> sent);

/// Steps 3-7 of such inputs, sent[i] being what the drive of inputs[i] sends.
std::vector<dsp::LogicTrace> pins_of(const Link& link, const std::vector<const Transmission*>& sent,
                                     const std::vector<channel::ChainInput>& inputs,
                                     const std::atomic<bool>* stop, channel::StageClock* clock);

/// A group among trials that run together.
struct TrialSpan {
  std::size_t first, n;
};

/// So many trials in groups, the last of which may be smaller.
std::vector<TrialSpan> groups_of(std::size_t trials);

/// To each of these.
std::vector<const Transmission*> pointers(const std::vector<Transmission>& sent);

/// Adds what a trial costs.
void add_cost(GroupResult& result, const Link& link, const Transmission& sent);

}  // namespace sim
