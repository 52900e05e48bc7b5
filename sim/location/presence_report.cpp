#include "sim/location/presence_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "channel/photodiode.hpp"
#include "sim/columns/columns_table.hpp"
#include "sim/columns/stop_column.hpp"

namespace sim {
namespace {

using Point = PresencePointRun;

double irradiance_mw_per_m2(const Point& point) { return point.settings.light.signal.value * 1e3; }

double photocurrent_na(const Point& point) {
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

bool is_coarse(const Point& point) {
  const double noise = point.result->noise_over_step;
  return noise < least_noise_in_steps ||
         noise * std::sqrt(samples_summed(point.settings)) < least_values_in_noise;
}

std::string outside_text(const Point& point) {
  if (point.result->clipped > 0) return "clipped";
  return is_coarse(point) ? "steps" : "";
}

// ---- a point ----

void add_light(Columns<Point>& columns) {
  columns
      .real({"irradiance_mw_per_m2", "mW/m2", "light of the device at the photodiode"},
            irradiance_mw_per_m2)
      .known_before()
      .headed({{"", "irradiance", "[mW/m2]"}, number_width})
      .spared_before(1);
  columns.real({"photocurrent_na", "nA", "photocurrent of it while lit"}, photocurrent_na)
      .known_before()
      .headed({{"photo-", "current", "[nA]"}, number_width})
      .spared_before(2);
}

void add_noise(Columns<Point>& columns) {
  columns
      .real({"signal", "1", "mean of the statistic without noise, in units of the noise"},
            [](const Point& p) { return p.result->signal; })
      .called("statistic of the light [noise]");
  columns.real({"noise_v", "V", "noise of a sample without light, rounding included"},
               [](const Point& p) { return p.result->noise_v; });
  columns
      .real(
          {"noise_in_steps", "1", "the same over a step of the ADC; theory: from 0.5 on"},
          [](const Point& p) { return p.result->noise_over_step; }, significant(3))
      .headed({{"noise", "[steps", "of ADC]"}, 7})
      .spared_before(1);
  columns
      .real({"clipped", "1", "share of all samples that are clipped; theory: none"},
            [](const Point& p) { return p.result->clipped; })
      .called("samples clipped");
}

// ---- the ROC ----

/// "0.001"
std::string pfa_text(const Label& label) { return fmt::format("{:g}", std::get<double>(label)); }

template <class T>
auto of_roc(T RocPoint::*member) {
  return [member](const Point& p, std::size_t i) { return p.result->roc[i].*member; };
}

void add_roc_counts(Columns<Point>& columns) {
  columns
      .count({"n_false_alarms", "1", "windows without light above the threshold"},
             of_roc(&RocPoint::false_alarms))
      .on({"false_alarm"})
      .called("falsely");
  columns
      .count({"n_detections", "1", "windows with light above the threshold"},
             of_roc(&RocPoint::detections))
      .on({"false_alarm"})
      .called("windows detected");
  columns
      .real({"threshold", "1", "of the statistic, in units of the noise"},
            of_roc(&RocPoint::threshold))
      .on({"false_alarm"})
      .called("threshold [noise]");
}

void add_roc_ratios(Columns<Point>& columns) {
  columns.words({}, [](const Point& p, std::size_t i) { return pfa_text(p.settings.pfa[i]); })
      .on({"false_alarm"})
      .headed({{"probability of", "false alarm,", "as set"}, 14});
  columns
      .ratio({"p_false_alarm", "1", "share of windows without light above the threshold"},
             of_roc(&RocPoint::false_alarm))
      .on({"false_alarm"})
      .headed({{"", "counted", "[interval]"}, -estimate_width})
      .called("false alarms");
  columns
      .ratio({"p_detection", "1", "share of windows with light above the threshold"},
             of_roc(&RocPoint::detection))
      .on({"false_alarm"})
      .headed({{"probability of", "detection, counted", "[interval]"}, -estimate_width})
      .called("detected")
      .spread_as([](const Label& pfa, std::size_t) {
        return TextColumn{{"", "Pd at Pfa = " + pfa_text(pfa), "[interval]"}, -estimate_width};
      })
      .drawn({"Detection", "probability of detection", false, "p_detection_theory"});
  columns
      .real({"p_detection_theory", "1", "probability of detection by the closed form"},
            of_roc(&RocPoint::detection_theory), fixed(4))
      .on({"false_alarm"})
      .headed({{"", "in", "theory"}, 7})
      .spread_as([](const Label&, std::size_t) {
        return TextColumn{{"", "in", "theory"}, 7};
      });
}

Columns<Point> made_columns() {
  Columns<Point> columns;
  columns.dimension({"false_alarm", "1", "probability of false alarm, as set"}, [](const Point& p) {
    return std::vector<Label>(p.settings.pfa.begin(), p.settings.pfa.end());
  });
  columns
      .count({"n_trials", "1", "windows with and windows without light"},
             [](const Point& p) { return p.result->trials; })
      .called("windows");
  add_light(columns);
  add_noise(columns);
  add_roc_counts(columns);
  add_roc_ratios(columns);
  add_stop_reason(columns);
  columns.words({}, outside_text).headed({{"closed", "form", "outside"}, -7});
  return columns;
}

std::string details(const LoadedScenario&, const Point& point) {
  return element_table(presence_columns(), "false_alarm", point);
}

}  // namespace

const Columns<PresencePointRun>& presence_columns() {
  static const Columns<PresencePointRun> columns = made_columns();
  return columns;
}

constinit const PointReport<PresencePointRun> presence_report{presence_columns, details};

}  // namespace sim
