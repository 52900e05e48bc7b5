#include "sim/exchange/exchange_experiment.hpp"

#include "channel/instruction_set.hpp"
#include "sim/exchange/exchange.hpp"
#include "sim/point_scenario.hpp"
#include "sim/run_sharing.hpp"
#include "sim/sweep.hpp"

namespace sim {
namespace {

ExchangePoint run_point(const Scenario& scenario, const std::vector<double>& coordinates,
                        const ExchangeOptions& options) {
  const Exchange exchange = make_exchange(scenario);
  ExchangePoint point{coordinates, exchange.irradiance_mw_per_m2, exchange.reflected_mw_per_m2,
                      exchange.outside};
  const auto runs = static_cast<std::uint32_t>(scenario.exchange.runs);
  RunSharing<ExchangeTally> sharing(
      {.runs = runs,
       .most_at_once = static_cast<std::uint32_t>(channel::trials_at_once()),
       .threads = options.threads,
       .stop = options.interrupt},
      [&](std::uint32_t first, int n) {
        return run_exchange(exchange, first, n, options.interrupt);
      });
  for (const ExchangeTally& lot : sharing()) point.tally += lot;
  return point;
}

}  // namespace

std::vector<ExchangePoint> run_exchanges(const LoadedScenario& scenario,
                                         const ExchangeOptions& options) {
  std::vector<ExchangePoint> points(count_points(scenario.sweep));
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].coordinates = point_coordinates(scenario.sweep, i);
    if (options.interrupt != nullptr && *options.interrupt) continue;
    points[i] =
        run_point(point_scenario(scenario, points[i].coordinates), points[i].coordinates, options);
    if (options.on_point && points[i].tally.n_runs > 0) options.on_point(points[i]);
  }
  return points;
}

}  // namespace sim
