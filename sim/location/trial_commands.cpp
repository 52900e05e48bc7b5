#include "sim/location/trial_commands.hpp"

#include "sim/location/accuracy_report.hpp"
#include "sim/location/location_settings.hpp"
#include "sim/location/presence_report.hpp"
#include "sim/location/presence_settings.hpp"

namespace sim {
namespace {

/// How results are said.
template <class Point>
struct Report {
  std::string (*header)(const LoadedScenario&);
  std::string (*row)(const LoadedScenario&, const Point&);
  std::string (*details)(const Point&);  // of a single point; null: its row says all
  Dataset (*dataset)(const LoadedScenario&, const std::string& command, const std::vector<Point>&);
};

template <class Settings, class Result>
void run_points(const ExperimentRun& run, const Measurement<Settings, Result>& measurement,
                const Report<TrialPoint<Settings, Result>>& report) {
  using Point = TrialPoint<Settings, Result>;
  const LoadedScenario& scenario = run.scenario;
  Rows rows(run);
  bool headed = false;
  const std::function<void(const Point&)> show = [&](const Point& point) {
    if (!std::exchange(headed, true)) rows.print(report.header(scenario));
    rows.print(report.row(scenario, point));
  };
  const TrialSharing sharing{.threads = run.threads, .interrupt = run.interrupt};
  const auto points = measure_points(scenario, measurement, sharing, show);
  if (points.empty()) return conclude_without_points(run);
  const bool single = report.details != nullptr && points.size() == 1 && points[0].result;
  conclude(run, rows, report.dataset(scenario, run.command, points),
           single ? report.details(points[0]) : "");
}

}  // namespace

void run_presence_scenario(const ExperimentRun& run) {
  run_points<PresenceSettings, PresenceResult>(
      run, {presence_settings, measure_presence},
      {presence_header, presence_row, roc_table, presence_dataset});
}

void run_location_scenario(const ExperimentRun& run) {
  run_points<LocationTrialsSettings, LocationTrials>(
      run, {location_settings, measure_location},
      {accuracy_header, accuracy_row, nullptr, accuracy_dataset});
}

}  // namespace sim
