#pragma once
// Listening: a receiver at a line for a long time, whose device is dark, or sends in its rhythm;
// what it accepts though nobody of its own sent it. A run is one trial as of a link, but of a given
// length.
#include <atomic>
#include <cstdint>
#include <vector>

#include "sim/false_accepts/false_accept_tally.hpp"
#include "sim/link/link.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/trial/heard_trials.hpp"

namespace sim {

struct FalseAcceptSetup {
  Link link;
  bool device_sends = false;
  dsp::Seconds duration;  // of a run
};

/// The scenario with what `listening.air` names among its disturbances.
Scenario with_air(const Scenario& scenario);

FalseAcceptSetup make_false_accepts(const Scenario& scenario);

/// What the device sends in a run: nothing, or whole messages from a random place of its rhythm on.
Transmission line_of(const FalseAcceptSetup& setup, std::uint32_t run);

/// Runs first ... first + n - 1 up to the pin. Worth nothing once `*stop` is true.
HeardTrials hear_runs(const FalseAcceptSetup& setup, std::uint32_t first, int n,
                      const std::atomic<bool>* stop = nullptr);

/// The same, decoded as a link does and counted.
FalseAcceptTally run_false_accepts(const FalseAcceptSetup& setup, std::uint32_t first, int n,
                                   const std::atomic<bool>* stop = nullptr);

/// Time of so many runs.
double hours_of(const FalseAcceptSetup& setup, std::uint64_t runs);

}  // namespace sim
