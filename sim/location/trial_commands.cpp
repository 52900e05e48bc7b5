#include "sim/location/trial_commands.hpp"

#include <utility>

#include "sim/location/accuracy_report.hpp"
#include "sim/location/location_settings.hpp"
#include "sim/location/presence_report.hpp"
#include "sim/location/presence_settings.hpp"
#include "sim/report/point_report.hpp"

namespace sim {
namespace {

template <class Settings, class Result>
void run_trials(const ExperimentRun& run, const Measurement<Settings, Result>& measurement,
                const PointReport<TrialPoint<Settings, Result>>& report) {
  auto points = points_to_measure(run.scenario, measurement, run.workers);
  if (points.empty()) return conclude_without_points(run);
  report_points(run, report, [&](const OnPoint<TrialPoint<Settings, Result>>& on_point) {
    measure_points(points, measurement, run.workers, on_point);
    return std::move(points);
  });
}

}  // namespace

void run_presence_scenario(const ExperimentRun& run) {
  run_trials<PresenceSettings, PresenceResult>(
      run, {presence_settings, measure_presence},
      {presence_header, presence_row,
       [](const LoadedScenario&, const PresencePointRun& point) { return roc_table(point); },
       presence_dataset});
}

void run_location_scenario(const ExperimentRun& run) {
  run_trials<LocationTrialsSettings, LocationTrials>(
      run, {location_settings, measure_location},
      {accuracy_header, accuracy_row, nullptr, accuracy_dataset});
}

}  // namespace sim
