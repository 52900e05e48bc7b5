#include "sim/location/accuracy_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "sim/location/trial_variables.hpp"
#include "sim/report/estimate_text.hpp"
#include "sim/report/text_table.hpp"
#include "sim/text/rounded_text.hpp"

namespace sim {
namespace {

/// Three NaNs where the readings bound nothing.
ErrorEllipse bound_ellipse(const LocationTrials& result) {
  if (result.bound) return error_ellipse(*result.bound);
  return {unset, unset, dsp::Radians(unset)};
}

double error_over_bound(const LocationTrials& result) {
  return result.rmse_m.value / result.bound_m();
}

std::vector<TextColumn> accuracy_columns(const LoadedScenario& scenario) {
  std::vector<TextColumn> columns = axis_columns(scenario.sweep);
  columns.push_back({{"", "rms error", "[m]"}, -estimate_width});
  columns.push_back({{"Cramer-", "Rao", "[m]"}, 7});
  columns.push_back({{"error", "over", "bound"}, 5});
  columns.push_back({{"bound's 95 %", "ellipse, half", "axes [m by m]"}, 15});
  columns.push_back({{"", "from +x", "[deg]"}, 7});
  columns.push_back({{"truth in the", "95 % region", "[interval]"}, -estimate_width});
  columns.push_back({{"", "", "located"}, 7});
  columns.push_back({{"ambi-", "guous", ""}, 5});
  columns.push_back({{"", "poor", "fit"}, 5});
  columns.push_back({{"under-", "deter-", "mined"}, 6});
  columns.push_back({{"not", "con-", "verged"}, 6});
  return columns;
}

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.3g}", value) : "-";
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

// ---- dataset ----

void add_estimate(TrialVariables<LocationPointRun>& to, const VariableFacts& facts,
                  Estimate LocationTrials::*member) {
  to.real(facts, [=](const LocationTrials& r) { return (r.*member).value; });
  to.real(
      {facts.name + "_ci_low", facts.unit, "lower end of the interval of the " + facts.long_name},
      [=](const LocationTrials& r) { return (r.*member).low; });
  to.real(
      {facts.name + "_ci_high", facts.unit, "upper end of the interval of the " + facts.long_name},
      [=](const LocationTrials& r) { return (r.*member).high; });
}

void add_bound(TrialVariables<LocationPointRun>& to) {
  to.real({"bound_m", "m", "root of the trace of the Cramer-Rao bound"},
          [](const LocationTrials& r) { return r.bound_m(); });
  to.real({"error_over_bound", "1", "rms error over that"}, error_over_bound);
  to.real({"ellipse_major_m", "m", "longer half axis of the bound's 95 % ellipse"},
          [](const LocationTrials& r) { return bound_ellipse(r).semi_major_m; });
  to.real({"ellipse_minor_m", "m", "shorter half axis of the bound's 95 % ellipse"},
          [](const LocationTrials& r) { return bound_ellipse(r).semi_minor_m; });
  to.real({"ellipse_direction_deg", "degree", "direction of the longer one from +x"},
          [](const LocationTrials& r) { return dsp::in_degrees(bound_ellipse(r).direction); });
}

void add_readings(TrialVariables<LocationPointRun>& to) {
  to.knowns({"irradiance_mw_per_m2", "mW/m2", "light of the device at each receiver"}, "reading",
            [](const LocationPointRun& p, std::size_t i) {
              return p.settings.readings[i].irradiance_w_per_m2 * 1e3;
            });
  to.knowns({"sigma_mw_per_m2", "mW/m2", "standard deviation of its reading"}, "reading",
            [](const LocationPointRun& p, std::size_t i) {
              return p.settings.readings[i].deviation_w_per_m2 * 1e3;
            });
}

}  // namespace

std::string accuracy_header(const LoadedScenario& scenario) {
  return table_head(accuracy_columns(scenario));
}

std::string accuracy_row(const LoadedScenario& scenario, const LocationPointRun& point) {
  const LocationTrials& result = point.result.value();
  const ErrorEllipse ellipse = bound_ellipse(result);
  std::vector<std::string> texts = coordinate_texts(scenario.sweep, point.coordinates);
  texts.push_back(error_text(result.rmse_m));
  texts.push_back(number(result.bound_m()));
  texts.push_back(number(error_over_bound(result)));
  texts.push_back(ellipse_text(ellipse));
  texts.push_back(number(std::round(dsp::in_degrees(ellipse.direction))));
  texts.push_back(estimate_text(result.region_coverage));
  for (const std::uint64_t n : result.count) texts.push_back(fmt::format("{}", n));
  return table_line(accuracy_columns(scenario), texts);
}

Dataset accuracy_dataset(const LoadedScenario& scenario, const std::string& command,
                         const std::vector<LocationPointRun>& points) {
  Dataset data = dataset_of(scenario, command);
  data.dimensions.push_back({{"outcome", "", "what locating came to"}, locate_outcome_names()});
  std::vector<double> numbers(points.front().settings.readings.size());
  std::iota(numbers.begin(), numbers.end(), 1);
  data.dimensions.push_back({{"reading", "1", "number of the receiver or heading"}, numbers});
  for (const LocationPointRun& point : points)
    data.n_runs += point.result ? point.result->trials() : 0;
  TrialVariables<LocationPointRun> to(data, points);
  to.count({"n_trials", "1", "times that locating was tried"}, [](const LocationPointRun& p) {
    return p.result ? static_cast<std::int64_t>(p.result->trials()) : 0;
  });
  to.counts({"n_outcomes", "1", "trials by what they came to"}, "outcome",
            [](const LocationTrials& r, std::size_t i) { return r.count[i]; });
  to.count({"n_covered", "1", "located ones with the truth in the ellipse of their covariance"},
           [](const LocationPointRun& p) {
             return p.result ? static_cast<std::int64_t>(p.result->covered) : 0;
           });
  to.count(
      {"squared_error_um2", "um2", "sum of the squared errors of the located ones"},
      [](const LocationPointRun& p) { return p.result ? std::llround(p.result->squared_um2) : 0; });
  add_estimate(to, {"rmse_m", "m", "rms error of the located ones"}, &LocationTrials::rmse_m);
  add_bound(to);
  add_estimate(to,
               {"coverage", "1",
                "share of the located ones with the truth in the ellipse of their covariance"},
               &LocationTrials::coverage);
  add_estimate(
      to, {"region_coverage", "1", "share of the located ones with the truth in their 95 % region"},
      &LocationTrials::region_coverage);
  add_readings(to);
  return data;
}

}  // namespace sim
