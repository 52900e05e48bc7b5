#include "sim/location/location_experiment.hpp"

#include <algorithm>

#include "sim/location/location_settings.hpp"

namespace sim {

constinit const Measurement<LocationBench, LocationTally, LocationPointRun> location_measurement{
    .unreached =
        [](const Scenario& s, const SourceLocations& places,
           const std::vector<double>& coordinates) {
          return LocationPointRun{coordinates, location_settings(s, places)};
        },
    .prepare = [](const Scenario& s, const SourceLocations& places,
                  const Workers&) { return LocationBench(location_settings(s, places)); },
    .most_at_once = trials_at_once<LocationBench>,
    .run = run_location,
    .ratio = [](const LocationBench&, const LocationTally& tally,
                double level) { return rms_error_m(tally, level); },
    .describe = [](LocationPointRun& point, const LocationBench& bench,
                   const LocationTally& tally) { point.result = bench.summed(tally); },
    .fits =
        [](const LocationBench&, const LocationTally& tally, std::uint32_t n) {
          return tally.trials.size() == n &&
                 std::ranges::all_of(tally.trials, [](const LocationTrial& trial) {
                   return static_cast<std::size_t>(trial.outcome) < LocationTrials::outcomes;
                 });
        }};

}  // namespace sim
