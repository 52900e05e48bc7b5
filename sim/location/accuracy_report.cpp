#include "sim/location/accuracy_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "sim/columns/stop_column.hpp"
#include "sim/text/rounded_text.hpp"

namespace sim {
namespace {

using AccuracyPoint = LocationPointRun;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Three NaNs where the readings bound nothing.
ErrorEllipse bound_ellipse(const LocationTrials& result) {
  if (result.bound) return error_ellipse(*result.bound);
  return {unknown, unknown, dsp::Radians(unknown)};
}

double error_over_bound(const LocationTrials& result) {
  return result.rmse_m.value / result.bound_m();
}

std::string error_text(const Estimate& e) {
  if (std::isnan(e.value)) return "-";
  return fmt::format("{} [{}, {}]", significant_text(e.value, 3),
                     significant_text(e.low, 3, Rounding::down),
                     significant_text(e.high, 3, Rounding::up));
}

std::string ellipse_text(const ErrorEllipse& e) {
  return std::isnan(e.semi_major_m)
             ? "-"
             : fmt::format("{:.2g} by {:.2g}", e.semi_major_m, e.semi_minor_m);
}

void add_error(Columns<AccuracyPoint>& columns) {
  columns
      .ratio(
          {"rmse_m", "m", "rms error of the located ones"},
          [](const AccuracyPoint& p) { return p.result->rmse_m; }, error_text)
      .headed({{"", "rms error", "[m]"}, -estimate_width})
      .drawn({"Error of location", "rms error [m] (dashed: Cramer-Rao bound)", true, "bound_m"});
}

void add_bound(Columns<AccuracyPoint>& columns) {
  columns
      .real(
          {"bound_m", "m", "root of the trace of the Cramer-Rao bound"},
          [](const AccuracyPoint& p) { return p.result->bound_m(); }, significant(3))
      .headed({{"Cramer-", "Rao", "[m]"}, 7})
      .called("Cramer-Rao bound");
  columns
      .real(
          {"error_over_bound", "1", "rms error over that"},
          [](const AccuracyPoint& p) { return error_over_bound(*p.result); }, significant(3))
      .headed({{"error", "over", "bound"}, 5});
  columns.words({}, [](const AccuracyPoint& p) { return ellipse_text(bound_ellipse(*p.result)); })
      .headed({{"bound's 95 %", "ellipse, half", "axes [m by m]"}, 15});
  columns.real({"ellipse_major_m", "m", "longer half axis of the bound's 95 % ellipse"},
               [](const AccuracyPoint& p) { return bound_ellipse(*p.result).semi_major_m; });
  columns.real({"ellipse_minor_m", "m", "shorter half axis of the bound's 95 % ellipse"},
               [](const AccuracyPoint& p) { return bound_ellipse(*p.result).semi_minor_m; });
  columns
      .real(
          {"ellipse_direction_deg", "degree", "direction of the longer one from +x"},
          [](const AccuracyPoint& p) {
            return dsp::in_degrees(bound_ellipse(*p.result).direction);
          },
          fixed(0))
      .headed({{"", "from +x", "[deg]"}, 7});
}

void add_coverage(Columns<AccuracyPoint>& columns) {
  columns
      .ratio({"coverage", "1",
              "share of the located ones with the truth in the ellipse of their covariance"},
             [](const AccuracyPoint& p) { return p.result->coverage; })
      .called("truth in the ellipse");
  columns
      .ratio(
          {"region_coverage", "1", "share of the located ones with the truth in their 95 % region"},
          [](const AccuracyPoint& p) { return p.result->region_coverage; })
      .headed({{"truth in the", "95 % region", "[interval]"}, -estimate_width})
      .drawn({"Truth in the region", "share of the located ones"});
}

/// In the order of LocateOutcome.
TextColumn outcome_heading(std::size_t outcome) {
  static const std::array<TextColumn, LocationTrials::outcomes> headings{
      {{{"", "", "located"}, 7},
       {{"ambi-", "guous", ""}, 5},
       {{"", "poor", "fit"}, 5},
       {{"under-", "deter-", "mined"}, 6},
       {{"not", "con-", "verged"}, 6}}};
  return headings.at(outcome);
}

void add_outcomes(Columns<AccuracyPoint>& columns) {
  columns
      .count({"n_outcomes", "1", "trials by what they came to"},
             [](const AccuracyPoint& p, std::size_t i) { return p.result->count[i]; })
      .on({"outcome"})
      .spread_as([](const Label&, std::size_t i) { return outcome_heading(i); });
  columns.count(
      {"n_covered", "1", "located ones with the truth in the ellipse of their covariance"},
      [](const AccuracyPoint& p) { return p.result->covered; });
  columns.count(
      {"squared_error_um2", "um2", "sum of the squared errors of the located ones"},
      [](const AccuracyPoint& p) { return std::llround(std::min(p.result->squared_um2, 9e18)); });
}

void add_readings(Columns<AccuracyPoint>& columns) {
  columns
      .real({"irradiance_mw_per_m2", "mW/m2", "light of the device at each receiver"},
            [](const AccuracyPoint& p, std::size_t i) {
              return p.settings.readings[i].irradiance_w_per_m2 * 1e3;
            })
      .known_before()
      .called("light")
      .on({"reading"});
  columns
      .real({"sigma_mw_per_m2", "mW/m2", "standard deviation of its reading"},
            [](const AccuracyPoint& p, std::size_t i) {
              return p.settings.readings[i].deviation_w_per_m2 * 1e3;
            })
      .known_before()
      .called("deviation")
      .on({"reading"});
}

void add_dimensions(Columns<AccuracyPoint>& columns) {
  columns.dimension({"outcome", "", "what locating came to"}, [](const AccuracyPoint&) {
    return std::vector<Label>(locate_outcome_names().begin(), locate_outcome_names().end());
  });
  columns.dimension({"reading", "1", "number of the receiver or heading"},
                    [](const AccuracyPoint& p) {
                      std::vector<Label> numbers;
                      for (std::size_t i = 1; i <= p.settings.readings.size(); ++i)
                        numbers.emplace_back(static_cast<double>(i));
                      return numbers;
                    });
}

}  // namespace

const Columns<LocationPointRun>& location_columns() {
  static const Columns<LocationPointRun> columns = [] {
    Columns<AccuracyPoint> made;
    add_dimensions(made);
    made.count({"n_trials", "1", "times that locating was tried"},
               [](const AccuracyPoint& p) { return p.result->trials(); });
    add_error(made);
    add_bound(made);
    add_coverage(made);
    add_outcomes(made);
    add_readings(made);
    add_stop_reason(made);
    return made;
  }();
  return columns;
}

constinit const PointReport<LocationPointRun> location_report{location_columns, nullptr};

}  // namespace sim
