#pragma once
// Listening at all points of its scenario's sweep.
#include <cstdint>
#include <vector>

#include "sim/counting/statistics.hpp"
#include "sim/counting/stop_rule.hpp"
#include "sim/engine/measurement.hpp"
#include "sim/false_accepts/false_accept_tally.hpp"
#include "sim/false_accepts/false_accepts.hpp"
#include "sim/link/operating_point.hpp"

namespace sim {

struct FalseAcceptPoint {
  std::vector<double> coordinates;   // one value an axis
  OperatingPoint operating{};        // its signal means nothing where the device is dark
  std::uint64_t validity_flags = 0;  // of sim/link/validity
  double hours = 0;                  // of line, all runs together
  FalseAcceptTally tally{};          // no runs: never reached
  StopReason stop = StopReason::interrupted;

  bool reached() const { return tally.n_runs > 0; }

  /// An hour of line, with the 95 % interval of event_rate, runs being the stretches. Of undetected
  /// errors NaN where nothing was sent.
  Estimate false_per_hour() const;
  Estimate undetected_per_hour() const;
};

/// Throws for what is wrong at any point of the sweep.
void check_false_accepts(const LoadedScenario& scenario);

extern const Measurement<FalseAcceptSetup, FalseAcceptTally, FalseAcceptPoint>
    false_accept_measurement;

}  // namespace sim
