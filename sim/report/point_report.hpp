#pragma once
// How the points of an experiment are said while they are measured, and what is said and written
// in the end.
#include <string>
#include <vector>

#include "sim/report/experiment_run.hpp"
#include "sim/report/point_runs.hpp"

namespace sim {

template <class Point>
struct PointReport {
  std::string (*header)(const LoadedScenario&);
  std::string (*row)(const LoadedScenario&, const Point&);
  std::string (*details)(const LoadedScenario&, const Point&);  // of a single one; null: none
  Dataset (*dataset)(const LoadedScenario&, const std::string& command, const std::vector<Point>&);
};

/// `measure(on_point)` gives all points.
template <class Point, class Measure>
void report_points(const ExperimentRun& run, const PointReport<Point>& report,
                   const Measure& measure) {
  const LoadedScenario& scenario = run.scenario;
  Rows rows(run.json);
  rows.print(report.header(scenario));
  const std::vector<Point> points =
      measure(OnPoint<Point>([&](const Point& point) { rows.print(report.row(scenario, point)); }));
  const bool single = report.details != nullptr && points.size() == 1 && points[0].reached();
  conclude(run, rows, report.dataset(scenario, run.command, points),
           single ? report.details(scenario, points[0]) : "");
}

}  // namespace sim
