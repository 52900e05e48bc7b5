#include "sim/location/presence_report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "channel/photodiode.hpp"
#include "sim/location/trial_variables.hpp"
#include "sim/report/estimate_text.hpp"
#include "sim/report/text_table.hpp"
#include "sim/text/number_text.hpp"

namespace sim {
namespace {

double irradiance_mw_per_m2(const PresencePointRun& point) {
  return point.settings.light.signal.value * 1e3;
}

double photocurrent_na(const PresencePointRun& point) {
  return channel::photocurrent(point.settings.meter.photodiode, point.settings.light.signal).value *
         1e9;
}

/// Below it rounding is no white noise (sim/location/presence.hpp).
constexpr double least_noise_in_steps = 0.5;

/// Sums of few rounded samples have few values: so many in a deviation of their noise at least, and
/// a probability is off by a hundredth at most (half a value of a normal density's height).
constexpr double least_values_in_noise = 20;

double samples_summed(const PresenceSettings& s) {
  const auto n = static_cast<double>(s.window_samples),
             m = static_cast<double>(s.reference_samples);
  return s.detector == Detector::dc_difference ? n * m / (n + m) : n;
}

bool is_coarse(const PresencePointRun& point) {
  const double noise = point.result->noise_over_step;
  return noise < least_noise_in_steps ||
         noise * std::sqrt(samples_summed(point.settings)) < least_values_in_noise;
}

std::string outside_text(const PresencePointRun& point) {
  if (point.result->clipped > 0) return "clipped";
  return is_coarse(point) ? "steps" : "";
}

std::vector<TextColumn> presence_columns(const LoadedScenario& scenario) {
  std::vector<TextColumn> columns = axis_columns(scenario.sweep);
  columns.push_back({{"", "irradiance", "[mW/m2]"}, number_width});
  columns.push_back({{"photo-", "current", "[nA]"}, number_width});
  columns.push_back({{"noise", "[steps", "of ADC]"}, 7});
  for (const double pfa :
       parse_values(scenario.base.presence.false_alarm, "presence.false_alarm")) {
    columns.push_back({{"", fmt::format("Pd at Pfa = {:g}", pfa), "[interval]"}, -estimate_width});
    columns.push_back({{"", "in", "theory"}, 7});
  }
  columns.push_back({{"closed", "form", "outside"}, -7});
  return columns;
}

std::vector<TextColumn> roc_columns() {
  return {{{"probability of", "false alarm,", "as set"}, 14},
          {{"", "counted", "[interval]"}, -estimate_width},
          {{"probability of", "detection, counted", "[interval]"}, -estimate_width},
          {{"", "in", "theory"}, 7}};
}

// ---- dataset ----

void add_point_variables(TrialVariables<PresencePointRun>& to) {
  to.count({"n_trials", "1", "windows with and windows without light"},
           [](const PresencePointRun& p) { return p.result ? std::int64_t{p.result->trials} : 0; });
  to.known({"irradiance_mw_per_m2", "mW/m2", "light of the device at the photodiode"},
           irradiance_mw_per_m2);
  to.known({"photocurrent_na", "nA", "photocurrent of it while lit"}, photocurrent_na);
  to.real({"signal", "1", "mean of the statistic without noise, in units of the noise"},
          [](const PresenceResult& r) { return r.signal; });
  to.real({"noise_v", "V", "noise of a sample without light, rounding included"},
          [](const PresenceResult& r) { return r.noise_v; });
  to.real({"noise_in_steps", "1", "the same over a step of the ADC; theory: from 0.5 on"},
          [](const PresenceResult& r) { return r.noise_over_step; });
  to.real({"clipped", "1", "share of all samples that are clipped; theory: none"},
          [](const PresenceResult& r) { return r.clipped; });
}

void add_probability(TrialVariables<PresencePointRun>& to, const std::string& name,
                     const std::string& what, Estimate RocPoint::*member) {
  const auto add = [&](const std::string& suffix, const std::string& of, double Estimate::*part) {
    to.reals({name + suffix, "1", of + what}, "false_alarm",
             [=](const PresenceResult& r, std::size_t i) { return r.roc[i].*member.*part; });
  };
  add("", "", &Estimate::value);
  add("_ci_low", "lower end of the interval of the ", &Estimate::low);
  add("_ci_high", "upper end of the interval of the ", &Estimate::high);
}

void add_roc_variables(TrialVariables<PresencePointRun>& to) {
  to.counts({"n_false_alarms", "1", "windows without light above the threshold"}, "false_alarm",
            [](const PresenceResult& r, std::size_t i) { return r.roc[i].false_alarms; });
  to.counts({"n_detections", "1", "windows with light above the threshold"}, "false_alarm",
            [](const PresenceResult& r, std::size_t i) { return r.roc[i].detections; });
  to.reals({"threshold", "1", "of the statistic, in units of the noise"}, "false_alarm",
           [](const PresenceResult& r, std::size_t i) { return r.roc[i].threshold; });
  add_probability(to, "p_false_alarm", "share of windows without light above the threshold",
                  &RocPoint::false_alarm);
  add_probability(to, "p_detection", "share of windows with light above the threshold",
                  &RocPoint::detection);
  to.reals({"p_detection_theory", "1", "probability of detection by the closed form"},
           "false_alarm",
           [](const PresenceResult& r, std::size_t i) { return r.roc[i].detection_theory; });
}

}  // namespace

std::string presence_header(const LoadedScenario& scenario) {
  return table_head(presence_columns(scenario));
}

std::string presence_row(const LoadedScenario& scenario, const PresencePointRun& point) {
  const PresenceResult& result = point.result.value();
  std::vector<std::string> texts = coordinate_texts(scenario.sweep, point.coordinates);
  texts.push_back(fmt::format("{:.4g}", irradiance_mw_per_m2(point)));
  texts.push_back(fmt::format("{:.4g}", photocurrent_na(point)));
  texts.push_back(fmt::format("{:.3g}", result.noise_over_step));
  for (const RocPoint& roc : result.roc) {
    texts.push_back(estimate_text(roc.detection));
    texts.push_back(fmt::format("{:.4f}", roc.detection_theory));
  }
  texts.push_back(outside_text(point));
  return table_line(presence_columns(scenario), texts);
}

std::string roc_table(const PresencePointRun& point) {
  std::string table = table_head(roc_columns());
  for (const RocPoint& roc : point.result.value().roc)
    table += table_line(
        roc_columns(), {fmt::format("{:g}", roc.pfa), estimate_text(roc.false_alarm),
                        estimate_text(roc.detection), fmt::format("{:.4f}", roc.detection_theory)});
  return table;
}

Dataset presence_dataset(const LoadedScenario& scenario, const std::string& command,
                         const std::vector<PresencePointRun>& points) {
  Dataset data = dataset_of(scenario, command);
  data.dimensions.push_back(
      {{"false_alarm", "1", "probability of false alarm, as set"}, points.front().settings.pfa});
  for (const PresencePointRun& point : points)
    data.n_runs += point.result ? point.result->trials : 0;
  TrialVariables<PresencePointRun> variables(data, points);
  add_point_variables(variables);
  add_roc_variables(variables);
  return data;
}

}  // namespace sim
