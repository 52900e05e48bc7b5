#pragma once
// An exchange at all points of its scenario's sweep.
#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

#include "sim/exchange/exchange_tally.hpp"
#include "sim/scenario.hpp"

namespace sim {

struct ExchangePoint {
  std::vector<double> coordinates;  // one value an axis
  double irradiance_mw_per_m2 = 0, reflected_mw_per_m2 = 0;
  std::uint64_t outside = 0;  // of sim/validity
  ExchangeTally tally{};      // no runs: never reached
};

struct ExchangeOptions {
  int threads = 1;
  const std::atomic<bool>* interrupt = nullptr;
  std::function<void(const ExchangePoint&)> on_point{};  // after each
};

/// All points, in the order of the sweep. After an interrupt the one under way has the runs that
/// were finished, those behind it none.
std::vector<ExchangePoint> run_exchanges(const LoadedScenario& scenario,
                                         const ExchangeOptions& options);

}  // namespace sim
