#include "sim/exchange/exchange_experiment.hpp"

#include "channel/instruction_set.hpp"

namespace sim {
namespace {

void describe_exchange(ExchangePoint& point, const Exchange& exchange, const ExchangeTally& tally) {
  point.irradiance_mw_per_m2 = exchange.irradiance_mw_per_m2;
  point.reflected_mw_per_m2 = exchange.reflected_mw_per_m2;
  point.outside = exchange.outside;
  point.tally = tally;
}

}  // namespace

constinit const Measurement<Exchange, ExchangeTally, ExchangePoint> exchange_measurement{
    .unreached =
        [](const Scenario&, const SourceLocations&, const std::vector<double>& coordinates) {
          return ExchangePoint{.coordinates = coordinates};
        },
    .prepare = [](const Scenario& s, const SourceLocations&,
                  const Workers&) { return make_exchange(s); },
    .most_at_once = [](const Exchange&, std::uint32_t,
                       int) { return static_cast<std::uint32_t>(channel::trials_at_once()); },
    .run = run_exchange,
    .ratio = [](const Exchange&, const ExchangeTally& tally,
                double level) { return clustered_ratio(tally.losses, level); },
    .describe = describe_exchange,
    .fits =
        [](const Exchange&, const ExchangeTally& tally) {
          return tally.losses.is_sound() && tally.direction[0].losses.is_sound() &&
                 tally.direction[1].losses.is_sound();
        }};

}  // namespace sim
