#include "sim/location/presence_experiment.hpp"

#include "sim/location/presence_settings.hpp"

namespace sim {

constinit const Measurement<PresenceBench, PresenceTally, PresencePointRun> presence_measurement{
    .unreached =
        [](const Scenario& s, const SourceLocations& places,
           const std::vector<double>& coordinates) {
          return PresencePointRun{coordinates, presence_settings(s, places)};
        },
    .prepare = [](const Scenario& s, const SourceLocations& places,
                  const Workers&) { return PresenceBench(presence_settings(s, places)); },
    .most_at_once = trials_at_once<PresenceBench>,
    .run = run_presence,
    .describe = [](PresencePointRun& point, const PresenceBench& bench,
                   const PresenceTally& tally) { point.result = bench.result(tally); }};

}  // namespace sim
