#pragma once
// An exchange at all points of its scenario's sweep.
#include <cstdint>
#include <vector>

#include "sim/engine/measurement.hpp"
#include "sim/exchange/exchange.hpp"
#include "sim/exchange/exchange_tally.hpp"

namespace sim {

struct ExchangePoint {
  std::vector<double> coordinates;  // one value an axis
  double irradiance_mw_per_m2 = 0, reflected_mw_per_m2 = 0;
  std::uint64_t outside = 0;  // of sim/link/validity
  ExchangeTally tally{};      // no runs: never reached

  bool reached() const { return tally.n_runs > 0; }
};

extern const Measurement<Exchange, ExchangeTally, ExchangePoint> exchange_measurement;

}  // namespace sim
