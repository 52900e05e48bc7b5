#pragma once
// An exchange at all points of its scenario's sweep.
#include <cstdint>
#include <vector>

#include "sim/counting/stop_rule.hpp"
#include "sim/engine/measurement.hpp"
#include "sim/shared_link/shared_link.hpp"
#include "sim/shared_link/shared_link_tally.hpp"

namespace sim {

struct SharedLinkPoint {
  std::vector<double> coordinates;  // one value an axis
  double irradiance_mw_per_m2 = 0, reflected_mw_per_m2 = 0;
  std::uint64_t validity_flags = 0;  // of sim/link/validity
  SharedLinkTally tally{};           // no runs: never reached
  StopReason stop = StopReason::interrupted;

  bool reached() const { return tally.n_runs > 0; }
};

extern const Measurement<SharedLinkSetup, SharedLinkTally, SharedLinkPoint> shared_link_measurement;

}  // namespace sim
