#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <tuple>
#include <utility>

#include "sim/loading/point_scenario.hpp"
#include "sim/location/accuracy_report.hpp"
#include "sim/location/location_sections.hpp"
#include "sim/location/location_settings.hpp"
#include "sim/picture/floor_plan.hpp"
#include "sim/picture/svg.hpp"
#include "sim/scenario/sweep.hpp"
#include "sim/section/dataset_cells.hpp"
#include "sim/section/dataset_shares.hpp"
#include "sim/section/dataset_words.hpp"
#include "sim/section/experiment_section.hpp"
#include "sim/section/picture_sections.hpp"

namespace sim {
namespace {

/// Locating takes some milliseconds a trial, and some tens a point; more would cover each other.
std::uint32_t dots_at_each(std::size_t points) {
  constexpr std::uint32_t most_dots = 200, most_points = 20;
  return points == 0 || points > most_points ? 0 : most_dots / static_cast<std::uint32_t>(points);
}

/// "located", "poor fit": what locating may come to.
std::vector<std::string> outcome_kinds(const Dataset& data) {
  const Dataset::Dimension& outcomes = dimension_named(data, "outcome");
  std::vector<std::string> kinds;
  for (std::size_t i = 0; i < outcomes.size(); ++i)
    kinds.push_back(plain_words(value_text(outcomes, i)));
  return kinds;
}

/// ": located 1792 times, ambiguous 6": of all points.
std::string outcomes_text(const Dataset& data) {
  const std::vector<std::string> kinds = outcome_kinds(data);
  const DatasetCells cells(data, "n_outcomes");
  std::string text;
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    std::uint64_t count = 0;
    for (std::size_t i = kind; i < cells.size(); i += kinds.size()) count += cells.count(i);
    if (count > 0)
      text += fmt::format("{}{} {}{}", text.empty() ? ": " : ", ", kinds[kind], count,
                          !text.empty() ? ""
                          : count == 1  ? " time"
                                        : " times");
  }
  return text;
}

std::string size_of_location(const Dataset& data) {
  const std::size_t points = measured_points(data).size();
  return fmt::format("Locating was tried {} time{}{}{}.\n", data.n_runs,
                     data.n_runs == 1 ? "" : "s",
                     points > 1 ? fmt::format(" at {} points", points) : "", outcomes_text(data));
}

ShareBars outcomes_of(const Dataset& data) {
  const std::vector<std::string> kinds = outcome_kinds(data);
  const DatasetCells cells(data, "n_outcomes");
  return point_shares(data, "What locating came to", "the trials by their outcome", kinds,
                      [&](std::size_t point) {
                        std::vector<std::uint64_t> counts;
                        for (std::size_t i = 0; i < kinds.size(); ++i)
                          counts.push_back(cells.count(point * kinds.size() + i));
                        return counts;
                      });
}

/// Each receiver once, though it stands there at many points.
class DrawnReceivers {
 public:
  void add(const Reading& reading) {
    const channel::Pose& r = reading.receiver;
    if (marks_.try_emplace(std::tuple(r.x, r.y, r.yaw.value)).second)
      all_.push_back({.at = {r.x, r.y}, .heading = r.yaw.value});
  }
  const std::vector<PlanMark>& all() const { return all_; }

 private:
  std::map<std::tuple<double, double, double>, bool> marks_;
  std::vector<PlanMark> all_;
};

/// Where the first trials of a point located the device: those that were counted.
std::vector<PlanDots::Dot> located_by(const LocationTrialsSettings& settings,
                                      std::uint32_t trials) {
  std::vector<PlanDots::Dot> dots;
  if (trials == 0) return dots;
  for (const Location& location : locate_first_trials(settings, trials))
    if (location.outcome == LocateOutcome::located)
      dots.push_back({{location.places.front().at.at.x, location.places.front().at.at.y}});
  return dots;
}

/// A point of the sweep on the map.
struct MapPoint {
  std::string place;  // "location.relative_sigma = 0.01"
  std::uint32_t trials = 0;
  std::vector<PlanDots::Dot> located;  // by these trials
};

/// "location.relative_sigma = 0.01: 22 of the first 22 trials located it".
std::string located_text(const std::string& place, std::size_t located, std::size_t trials) {
  const std::string count =
      trials > 0 ? fmt::format("{} of the first {} trials located it", located, trials) : "";
  return place + (place.empty() || count.empty() ? "" : ": ") + count;
}

/// A line of the legend for each point, or where they are more than colours and look alike one for
/// all.
void add_dots(FloorPlan& plan, const std::vector<MapPoint>& points) {
  if (points.size() <= curve_colours) {
    for (const MapPoint& point : points)
      plan.dots.push_back({.label = located_text(point.place, point.located.size(), point.trials),
                           .dots = point.located,
                           .colour = plan.dots.size(),
                           .is_in_place = true});
    return;
  }
  PlanDots all{.label = {}, .dots = {}, .is_in_place = true};
  std::size_t trials = 0;
  for (const MapPoint& point : points) {
    trials += point.trials;
    all.dots.insert(all.dots.end(), point.located.begin(), point.located.end());
  }
  all.label = located_text(fmt::format("{} points", points.size()), all.dots.size(), trials);
  plan.dots.push_back(std::move(all));
}

/// Nothing is drawn of an ellipse that is not known, where the readings bound nothing.
FloorPlan plan_of(const StoredDataset& stored) {
  const Dataset& data = stored.data;
  FloorPlan plan{.title = "How well it is located",
                 .description =
                     "Devices (rings) and receivers (arrowheads) from above; each ellipse "
                     "is that of the Cramer-Rao bound, within which 95 % of the best "
                     "estimates lie"};
  const DatasetCells major(data, "ellipse_major_m"), minor(data, "ellipse_minor_m"),
      direction(data, "ellipse_direction_deg");
  DrawnReceivers receivers;
  std::vector<MapPoint> drawn;
  const std::vector<std::size_t> points = measured_points(data);
  for (const std::size_t point : points) {
    const LocationTrialsSettings settings =
        location_settings(point_scenario(stored.scenario, point_coordinates(data.axes, point)),
                          stored.scenario.places);
    for (const Reading& reading : settings.readings) receivers.add(reading);
    const std::uint32_t trials = std::min(dots_at_each(points.size()), settings.trials);
    const std::size_t colour = points.size() <= curve_colours ? drawn.size() : 0;
    drawn.push_back({place_text(data, point), trials, located_by(settings, trials)});
    const PlanPoint truth{settings.truth.x, settings.truth.y};
    plan.devices.push_back({.at = truth, .colour = {}, .is_solid = false});
    if (std::isfinite(major[point]))
      plan.ellipses.push_back(
          {truth, major[point], minor[point], dsp::degrees(direction[point]).value, colour});
  }
  plan.receivers = receivers.all();
  if (dots_at_each(points.size()) > 0)
    plan.description += fmt::format("; dots are where the first trials{} located it",
                                    points.size() == 1 ? "" : " of each point");
  add_dots(plan, drawn);
  return plan;
}

/// Each point has a device, but not each an ellipse.
std::string left_out_note(const FloorPlan& plan) {
  const std::size_t points = plan.devices.size(), known = plan.ellipses.size();
  const std::size_t drawn = drawn_ellipses(plan).size();
  std::string text;
  if (known < points)
    text += fmt::format("Of {} of {} points there is no ellipse, as the readings bound nothing.\n",
                        points - known, points);
  if (drawn < known)
    text += fmt::format(
        "{} of {} ellipses are left out: a half axis is longer than all the rest is wide.\n",
        known - drawn, known);
  return text;
}

PageSection map_of(const StoredDataset& stored) {
  const FloorPlan plan = plan_of(stored);
  return {
      .heading = plan.title,
      .text = left_out_note(plan),
      .picture = PagePicture{"map", plan.description, floor_plan_as_svg(plan)},
      .table = dataset_table(stored.data, {{"ellipse_major_m", "longer half axis [m]"},
                                           {"ellipse_minor_m", "shorter half axis [m]"},
                                           {"ellipse_direction_deg", "longer one from +x [deg]"}})};
}

/// Of what the share is known: of files of older versions the ellipse of the covariance.
struct HeldShare {
  explicit HeldShare(const Dataset& data)
      : of_region(find_variable(data, "region_coverage") != nullptr) {}

  bool of_region;
  std::string variable() const { return of_region ? "region_coverage" : "coverage"; }
  std::string of() const { return of_region ? "region" : "ellipse"; }
};

void add_location_charts(ReportSection& report, const Dataset& data) {
  add_chart(report, swept_chart(data, drawn_column(location_columns(), "rmse_m")));
  const HeldShare held(data);
  add_chart(report,
            swept_chart(data, {held.variable(),
                               {"Truth in the " + held.of(), "share of the located ones"}}));
}

}  // namespace

ReportSection location_section(const std::string& name, const StoredDataset& stored) {
  const Dataset& data = stored.data;
  ReportSection report{name, data.title, size_of_location(data)};
  const HeldShare held(data);
  report.summary +=
      extremes(data, "rmse_m", "The rms error of the located ones", " m") +
      extremes(data, "error_over_bound",
               "That error over its Cramer-Rao bound, the least of any unbiased estimate,") +
      extremes(data, held.variable(), "The coverage of the 95 % " + held.of()) +
      missing_points(stored);
  report.first.push_back(map_of(stored));
  add_location_charts(report, data);
  report.sections.push_back(shares_section("outcomes", outcomes_of(data)));
  const auto columns = [&](const std::vector<std::string>& names) {
    return headed_columns(data, location_columns().facts(), names);
  };
  report.sections.push_back(
      {.heading = "Readings",
       .table = dataset_table(data, columns({"irradiance_mw_per_m2", "sigma_mw_per_m2"}))});
  add_closing(report, data,
              columns({"n_trials", "rmse_m", "bound_m", "error_over_bound", held.variable()}));
  return report;
}

}  // namespace sim
