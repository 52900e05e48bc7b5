#pragma once
// Listening at all points of its scenario's sweep.
#include <cstdint>
#include <vector>

#include "sim/counting/statistics.hpp"
#include "sim/engine/measurement.hpp"
#include "sim/link/operating_point.hpp"
#include "sim/listening/listening.hpp"
#include "sim/listening/listening_tally.hpp"

namespace sim {

struct ListeningPoint {
  std::vector<double> coordinates;  // one value an axis
  OperatingPoint operating{};       // its signal means nothing where the device is dark
  std::uint64_t outside = 0;        // of sim/link/validity
  double hours = 0;                 // of line, all runs together
  ListeningTally tally{};           // no runs: never reached

  bool reached() const { return tally.n_runs > 0; }

  /// An hour of line, with the 95 % interval of event_rate, runs being the stretches. Of undetected
  /// errors NaN where nothing was sent.
  Estimate false_per_hour() const;
  Estimate undetected_per_hour() const;
};

/// Throws for what is wrong at any point of the sweep.
void check_listening(const LoadedScenario& scenario);

extern const Measurement<Listening, ListeningTally, ListeningPoint> listening_measurement;

}  // namespace sim
