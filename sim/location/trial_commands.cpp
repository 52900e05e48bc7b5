#include "sim/location/trial_commands.hpp"

#include "sim/location/location_settings.hpp"
#include "sim/location/presence_settings.hpp"
#include "sim/report/point_report.hpp"

namespace sim {
namespace {

PresencePointRun unmeasured_presence(const Scenario& s, const Places& places,
                                     const std::vector<double>& coordinates) {
  return {coordinates, presence_settings(s, places)};
}

LocationPointRun unmeasured_location(const Scenario& s, const Places& places,
                                     const std::vector<double>& coordinates) {
  return {coordinates, location_settings(s, places)};
}

constexpr PointReport<PresencePointRun> presence_report{
    presence_header, presence_row,
    [](const LoadedScenario&, const PresencePointRun& point) { return roc_table(point); },
    presence_dataset};
constexpr PointReport<LocationPointRun> location_report{accuracy_header, accuracy_row, nullptr,
                                                        accuracy_dataset};

}  // namespace

constinit const Measurement<PresenceBench, PresenceTally, PresencePointRun> presence_measurement{
    .unreached = unmeasured_presence,
    .prepare = [](const Scenario& s, const Places& places,
                  const Workers&) { return PresenceBench(presence_settings(s, places)); },
    .most_at_once = trials_at_once<PresenceBench>,
    .run = run_presence,
    .describe = [](PresencePointRun& point, const PresenceBench& bench,
                   const PresenceTally& tally) { point.result = bench.result(tally); }};

constinit const Measurement<LocationBench, LocationTally, LocationPointRun> location_measurement{
    .unreached = unmeasured_location,
    .prepare = [](const Scenario& s, const Places& places,
                  const Workers&) { return LocationBench(location_settings(s, places)); },
    .most_at_once = trials_at_once<LocationBench>,
    .run = run_location,
    .describe = [](LocationPointRun& point, const LocationBench& bench,
                   const LocationTally& tally) { point.result = bench.summed(tally); }};

constinit const ExperimentEngine presence_engine =
    experiment_engine<presence_measurement, presence_report>;
constinit const ExperimentEngine location_engine =
    experiment_engine<location_measurement, location_report>;

}  // namespace sim
