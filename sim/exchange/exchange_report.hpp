#pragma once
// An exchange at all points of its scenario's sweep, and what people and programs read of it.
#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "sim/dataset.hpp"
#include "sim/exchange/exchange.hpp"
#include "sim/scenario.hpp"

namespace sim {

struct ExchangePoint {
  std::vector<double> coordinates;  // one value an axis
  double irradiance_mw_per_m2 = 0, reflected_mw_per_m2 = 0;
  std::uint64_t outside = 0;  // of sim/validity
  ExchangeTally tally{};      // no runs: never reached
};

/// Both directions together.
DirectionTally together(const ExchangeTally& tally);

struct ExchangeOptions {
  int threads = 1;
  const std::atomic<bool>* interrupt = nullptr;
  std::function<void(const ExchangePoint&)> on_point{};  // after each
};

/// All points, in the order of the sweep. After an interrupt the one under way has the runs that
/// were finished, those behind it none.
std::vector<ExchangePoint> run_exchanges(const LoadedScenario& scenario,
                                         const ExchangeOptions& options);

std::string exchange_header(const std::vector<Axis>& axes);
std::string exchange_row(const std::vector<Axis>& axes, const ExchangePoint& point);
/// Each direction of one point, and why messages were refused.
std::string direction_table(const ExchangePoint& point);

Dataset exchange_dataset(const LoadedScenario& scenario, const std::string& command,
                         const std::vector<ExchangePoint>& points);

}  // namespace sim
