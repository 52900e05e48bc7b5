#pragma once
// Trials up to step 7: what was sent, and what each pin made of it.
#include <atomic>
#include <cstdint>
#include <vector>

#include "sim/trial/trial.hpp"

namespace sim {

struct HeardTrials {
  std::vector<Transmission> sent;
  std::vector<dsp::LogicTrace> pins;
  Profile profile;
};

/// Trials first ... first + n - 1 in any fidelity, as they come (not by importance sampling). Worth
/// nothing once `*stop` is true: it then gives up soon. `profiled`: with where the time went.
HeardTrials hear_trials(const Link& link, std::uint32_t first, int n,
                        const std::atomic<bool>* stop = nullptr, bool profiled = false);

}  // namespace sim
