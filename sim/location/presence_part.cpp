#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "sim/location/location_parts.hpp"
#include "sim/page/dataset_words.hpp"
#include "sim/page/experiment_part.hpp"
#include "sim/page/picture_sections.hpp"

namespace sim {
namespace {

constexpr double surely = 0.9;

std::string size_of(const Dataset& data) {
  const std::size_t points = measured_points(data).size();
  return fmt::format("{} windows with and {} without light were judged{}.\n", data.n_runs,
                     data.n_runs, points > 1 ? fmt::format(" at {} points", points) : "");
}

/// The longest stretch of points at which a curve is at `surely` or more.
struct Span {
  std::string curve;
  double from = 0, to = 0;
  double length() const { return to - from; }
};

std::optional<Span> span_of(const ChartCurve& curve) {
  std::optional<Span> longest, now;
  for (const ChartPoint& point : curve.points) {
    if (point.y < surely) {
      now.reset();
      continue;
    }
    if (!now) now = {curve.name, point.x, point.x};
    now->to = point.x;
    if (!longest || now->length() >= longest->length()) longest = now;
  }
  return longest;
}

std::string in_words(const Span& span, const ChartAxis& x) {
  return span.from == span.to
             ? fmt::format("{} {:g} ({})", x.label, span.from, span.curve)
             : fmt::format("{} from {:g} to {:g} ({})", x.label, span.from, span.to, span.curve);
}

/// The widest of all curves, and how that of the others is less.
std::string detected_where(const Chart& chart) {
  std::vector<Span> spans;
  std::size_t nowhere = 0;
  for (const ChartCurve& curve : chart.curves) {
    if (curve.kind != CurveKind::measured) continue;
    if (const auto span = span_of(curve))
      spans.push_back(*span);
    else
      ++nowhere;
  }
  if (spans.empty())
    return "At no point that was measured is the device noticed in 90 % of the windows or more.\n";
  const auto [narrowest, widest] = std::ranges::minmax_element(spans, {}, &Span::length);
  std::string text = fmt::format("The device is noticed in 90 % of the windows or more at {}",
                                 in_words(*widest, chart.x));
  if (nowhere > 0)
    text += fmt::format(", but nowhere by {} of {} curves", nowhere, nowhere + spans.size());
  else if (narrowest->length() < widest->length())
    text += fmt::format(", but only at {}", in_words(*narrowest, chart.x));
  return text + ".\n";
}

/// A curve each of so many points at most can be told apart.
constexpr std::size_t most_curves = 12;

void add_charts(ReportPart& part, const Dataset& data) {
  const DrawnVariable detection{.name = "p_detection",
                                .title = "Detection",
                                .label = "probability of detection",
                                .theory = "p_detection_theory"};
  const std::optional<Chart> swept = swept_chart(data, detection);
  if (swept) part.verdict += detected_where(*swept);
  add_chart(part, swept);
  if (measured_points(data).size() > most_curves) return;
  DrawnVariable roc = detection;
  roc.title = "Receiver operating characteristic (ROC)";
  add_chart(part, dimension_chart(data, roc));
}

}  // namespace

ReportPart presence_part(const std::string& name, const StoredDataset& stored) {
  const Dataset& data = stored.data;
  ReportPart part{name, data.title, size_of(data)};
  add_charts(part, data);
  part.verdict += missing_points(stored);
  part.sections.push_back({.heading = "Detections and false alarms",
                           .table = dataset_table(data, {{"p_detection", "detected"},
                                                         {"p_detection_theory", "in theory"},
                                                         {"p_false_alarm", "false alarms"},
                                                         {"n_detections", "windows detected"},
                                                         {"n_false_alarms", "falsely"},
                                                         {"threshold", "threshold [noise]"}})});
  add_closing(part, data,
              {{"n_trials", "windows"},
               {"irradiance_mw_per_m2", "irradiance [mW/m2]"},
               {"photocurrent_na", "photocurrent [nA]"},
               {"signal", "signal [noise]"},
               {"noise_in_steps", "noise [steps of the ADC]"},
               {"clipped", "samples clipped"}});
  return part;
}

}  // namespace sim
