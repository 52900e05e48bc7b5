#include "sim/location/presence_experiment.hpp"

#include <algorithm>

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
    .ratio = [](const PresenceBench&, const PresenceTally& tally,
                double level) { return detection(tally, level); },
    .describe = [](PresencePointRun& point, const PresenceBench& bench,
                   const PresenceTally& tally) { point.result = bench.result(tally); },
    .fits =
        [](const PresenceBench& bench, const PresenceTally& tally, std::uint32_t n) {
          const std::size_t thresholds = bench.no_trials().detections.size();
          const auto are_of = [&](const std::vector<std::uint64_t>& counts) {
            return counts.size() == thresholds &&
                   std::ranges::all_of(counts,
                                       [&](std::uint64_t count) { return count <= tally.trials; });
          };
          return tally.trials == n && are_of(tally.detections) && are_of(tally.false_alarms);
        }};

}  // namespace sim
