#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/location/location_sections.hpp"
#include "sim/location/presence_report.hpp"
#include "sim/section/curve_span.hpp"
#include "sim/section/dataset_cells.hpp"
#include "sim/section/dataset_words.hpp"
#include "sim/section/experiment_section.hpp"

namespace sim {
namespace {

constexpr double surely = 0.9;

std::string size_of_presence(const Dataset& data) {
  const std::size_t points = measured_points(data).size();
  return fmt::format("{} windows with and {} without light were judged{}.\n", data.n_runs,
                     data.n_runs, points > 1 ? fmt::format(" at {} points", points) : "");
}

double value_of(const Dataset::Dimension& dimension, std::size_t i) {
  const auto* values = std::get_if<std::vector<double>>(&dimension.values);
  return values == nullptr ? 0 : (*values)[i];
}

/// The curves of the least probability of false alarm, which alone are compared.
std::vector<ChartCurve> strictest(const Chart& chart, const std::string& false_alarm) {
  std::vector<ChartCurve> curves;
  for (ChartCurve curve : chart.curves) {
    if (curve.kind != CurveKind::measured || !curve.name.ends_with(false_alarm)) continue;
    curve.name.resize(curve.name.size() - false_alarm.size());
    if (curve.name.ends_with(", ")) curve.name.resize(curve.name.size() - 2);
    curves.push_back(std::move(curve));
  }
  return curves;
}

/// The narrowest stretch that is another than the widest; nothing where all are one.
std::optional<CurveSpan> narrowest_other(const std::vector<CurveSpan>& spans,
                                         const CurveSpan& widest) {
  std::optional<CurveSpan> found;
  for (const CurveSpan& span : spans)
    if ((span.from != widest.from || span.to != widest.to) &&
        (!found || span.length() < found->length()))
      found = span;
  return found;
}

/// The widest of the curves, and how that of the others is less.
std::string detected_where(const std::vector<ChartCurve>& curves, const Axis& x) {
  std::vector<CurveSpan> spans;
  for (const ChartCurve& curve : curves)
    if (const auto span = longest_span(curve, surely)) spans.push_back(*span);
  if (spans.empty())
    return "at no point that was simulated is the device noticed in 90 % of the windows or more.\n";
  CurveSpan widest = *std::ranges::max_element(spans, {}, &CurveSpan::length);
  const std::optional<CurveSpan> other = narrowest_other(spans, widest);
  const bool is_for_all = spans.size() == curves.size() && !other;
  if (is_for_all) widest.curve.clear();
  std::string text = fmt::format("the device is noticed in 90 % of the windows or more at {}",
                                 in_words(widest, x));
  if (is_for_all && spans.size() > 1)
    text += spans.size() == 2 ? ", in both cases" : fmt::format(", in all {} cases", spans.size());
  else if (spans.size() < curves.size())
    text +=
        fmt::format(", but nowhere in {} of {} cases", curves.size() - spans.size(), curves.size());
  else if (other)
    text += fmt::format(", but {}at {}", other->length() < widest.length() ? "only " : "",
                        in_words(*other, x));
  return text + ".\n";
}

/// The least probability of false alarm; nothing where none is set.
std::optional<std::size_t> strictest_alarm(const Dataset::Dimension& alarms) {
  std::optional<std::size_t> least;
  for (std::size_t i = 0; i < alarms.size(); ++i)
    if (!least || value_of(alarms, i) < value_of(alarms, *least)) least = i;
  return least;
}

/// Where no number is swept: how often at the point, or of several where least and most.
std::string detected_shares(const Dataset& data, std::size_t alarm, std::size_t alarms) {
  const DatasetCells shares(data, "p_detection");
  const auto cell = [&](std::size_t point) { return point * alarms + alarm; };
  std::vector<std::size_t> known = measured_points(data);
  std::erase_if(known, [&](std::size_t point) { return std::isnan(shares[cell(point)]); });
  if (known.empty()) return "";
  const auto [least, most] =
      std::ranges::minmax_element(known, {}, [&](std::size_t i) { return shares[cell(i)]; });
  if (known.size() == 1)
    return fmt::format("the device is noticed in {} of the windows.\n", shares.text(cell(*least)));
  if (shares.text(cell(*least)) == shares.text(cell(*most)))
    return fmt::format("the device is noticed in {} of the windows at each of {} points.\n",
                       shares.text(cell(*least)), known.size());
  return fmt::format(
      "the device is noticed least at {}: in {} of the windows, and most at {}: in {}.\n",
      place_text(data, *least), shares.text(cell(*least)), place_text(data, *most),
      shares.text(cell(*most)));
}

std::string detection_words(const Dataset& data, const std::optional<Chart>& swept) {
  const Dataset::Dimension& alarms = dimension_named(data, "false_alarm");
  const std::optional<std::size_t> alarm = strictest_alarm(alarms);
  if (!alarm) return "";
  const std::string false_alarm = "false_alarm = " + value_text(alarms, *alarm);
  const std::string detected =
      swept ? detected_where(strictest(*swept, false_alarm), *widest_axis(data))
            : detected_shares(data, *alarm, alarms.size());
  return detected.empty() ? "" : fmt::format("With {} {}", false_alarm, detected);
}

/// A curve each of so many points at most can be told apart.
constexpr std::size_t most_curves = 12;

std::string roc_note(const Dataset& data) {
  if (measured_points(data).size() <= most_curves) return "";
  return fmt::format("Of more than {} points no ROC is drawn; --set chooses some.", most_curves);
}

void add_presence_charts(ReportSection& report, const Dataset& data) {
  const DrawnVariable detection = drawn_column(presence_columns(), "p_detection");
  const std::optional<Chart> swept = swept_chart(data, detection);
  report.summary += detection_words(data, swept);
  add_chart(report, swept);
  if (measured_points(data).size() > most_curves) return;
  DrawnVariable roc = detection;
  roc.how.title = "Receiver operating characteristic (ROC)";
  add_chart(report, dimension_chart(data, roc));
}

}  // namespace

ReportSection presence_section(const std::string& name, const StoredDataset& stored) {
  const Dataset& data = stored.data;
  ReportSection report{name, data.title, size_of_presence(data)};
  add_presence_charts(report, data);
  report.summary += missing_points(stored);
  const auto columns = [&](const std::vector<std::string>& names) {
    return headed_columns(data, presence_columns().facts(), names);
  };
  report.sections.push_back(
      {.heading = "Detections and false alarms",
       .text = roc_note(data),
       .table = dataset_table(data, columns({"p_detection", "p_detection_theory", "p_false_alarm",
                                             "n_detections", "n_false_alarms", "threshold"}))});
  add_closing(report, data,
              columns({"n_trials", "irradiance_mw_per_m2", "photocurrent_na", "signal",
                       "noise_in_steps", "clipped"}));
  return report;
}

}  // namespace sim
