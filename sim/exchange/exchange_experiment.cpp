#include "sim/exchange/exchange_experiment.hpp"

#include "channel/instruction_set.hpp"
#include "sim/exchange/exchange.hpp"

namespace sim {
namespace {

ExchangePoint run_point(const Scenario& scenario, const std::vector<double>& coordinates,
                        const Workers& workers) {
  if (workers.interrupted()) return {coordinates};
  const Exchange exchange = make_exchange(scenario);
  ExchangePoint point{coordinates, exchange.irradiance_mw_per_m2, exchange.reflected_mw_per_m2,
                      exchange.outside};
  RunSharing<ExchangeTally> sharing(
      {.runs = static_cast<std::uint32_t>(scenario.exchange.runs),
       .most_at_once = static_cast<std::uint32_t>(channel::trials_at_once()),
       .workers = workers},
      [&](std::uint32_t first, int n) {
        return run_exchange(exchange, first, n, workers.interrupt);
      });
  for (const ExchangeTally& lot : sharing()) point.tally += lot;
  return point;
}

}  // namespace

std::vector<ExchangePoint> run_exchanges(const LoadedScenario& scenario, const Workers& workers,
                                         const OnPoint<ExchangePoint>& on_point) {
  return run_points<ExchangePoint>(scenario, workers, on_point, run_point);
}

}  // namespace sim
