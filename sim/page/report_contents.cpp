#include "sim/page/report_contents.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <utility>

#include "sim/counting/statistics.hpp"
#include "sim/page/verdict.hpp"
#include "sim/picture/share_bars.hpp"
#include "sim/report/closing_lines.hpp"
#include "sim/report/estimate_text.hpp"
#include "sim/report/report_table.hpp"
#include "sim/report/result_charts.hpp"
#include "sim/report/text_table.hpp"
#include "sim/result/ranking.hpp"
#include "sim/scenario/sweep.hpp"
#include "sim/trace/trace_picture.hpp"

namespace sim {
namespace {

std::string title_of(const ReportedResult& reported) {
  return reported.result.title.empty() ? reported.name : reported.result.title;
}

PageTable table_of(const ExperimentResult& result) {
  PageTable table;
  for (const Axis& axis : result.axes) table.head.push_back(axis_name(axis));
  for (const char* name : {"irradiance [mW/m2]", "SNR [dB]", "frames", "lost", "FLR", "bit errors",
                           "BER", "undetected", "stopped by"})
    table.head.emplace_back(name);
  for (const PointResult& point : result.points) {
    if (!measured(point)) continue;
    std::vector<std::string> row = coordinate_texts(result.axes, point.coordinates);
    row.push_back(fmt::format("{:.4g}", point.operating.irradiance_mw_per_m2));
    row.push_back(fmt::format("{:.1f}", point.operating.snr_db));
    row.push_back(std::to_string(point.tally.n_frames));
    row.push_back(std::to_string(point.tally.n_frames_lost));
    row.push_back(estimate_text(frame_loss_ratio(point.tally, result.ci_level)));
    row.push_back(std::to_string(point.tally.n_bit_errors));
    row.push_back(estimate_text(bit_error_ratio(point.tally, result.ci_level)));
    row.push_back(std::to_string(point.tally.n_frames_undetected));
    row.emplace_back(stop_reason_name(point.stop));
    table.rows.push_back(std::move(row));
  }
  return table;
}

PageTable table_of(const Chart& chart) {
  PageTable table{.head = {"curve", chart.x.label, chart.y.label}, .rows = {}};
  for (const ChartCurve& curve : chart.curves)
    for (const ChartPoint& point : curve.points)
      table.rows.push_back({curve.name, fmt::format("{:.6g}", point.x),
                            curve.kind != CurveKind::measured
                                ? fmt::format("{:.3g}", point.y)
                                : estimate_text({point.y, point.low, point.high})});
  return table;
}

PageSection chart_section(Chart chart, const std::string& of) {
  std::string heading = chart.title + of;
  PageTable table = table_of(chart);
  return {.heading = std::move(heading),
          .picture = picture_of(std::move(chart)),
          .table = std::move(table)};
}

/// Curves of several results in one picture, each named by its file.
std::vector<Chart> charts_of(const std::vector<ReportedResult>& results) {
  std::vector<Chart> charts;
  for (const ReportedResult& reported : results)
    for (Chart& chart : result_charts(reported.result)) {
      if (results.size() > 1)
        for (ChartCurve& curve : chart.curves) curve.name = reported.name + ", " + curve.name;
      const auto same = std::ranges::find_if(charts, [&](const Chart& other) {
        return other.title == chart.title && other.x.label == chart.x.label;
      });
      if (same == charts.end())
        charts.push_back(std::move(chart));
      else
        std::ranges::move(chart.curves, std::back_inserter(same->curves));
    }
  return charts;
}

const char* const fates[] = {"delivered", "a line was heard, but not the one sent",
                             "characters were heard, but no line ended", "nothing was heard"};

std::vector<std::uint64_t> fates_of(const Tally& t) {
  return {t.n_frames - t.n_frames_lost, t.n_frames_lost - t.n_frames_unended - t.n_frames_unheard,
          t.n_frames_unended, t.n_frames_unheard};
}

/// The axes whose values have rows of their own: all, or where there are too many points the
/// longest.
std::vector<std::size_t> axes_of_rows(const std::vector<Axis>& axes) {
  constexpr std::size_t most_rows = 60;
  std::vector<std::size_t> all(axes.size());
  std::iota(all.begin(), all.end(), 0);
  if (count_points(axes) <= most_rows) return all;
  return {*std::ranges::max_element(all, {}, [&](std::size_t i) { return axes[i].values.size(); })};
}

ShareRow& row_of(std::vector<ShareRow>& rows, const std::string& label) {
  const auto found = std::ranges::find(rows, label, &ShareRow::label);
  if (found != rows.end()) return *found;
  return rows.emplace_back(ShareRow{label, std::vector<std::uint64_t>(std::size(fates))});
}

/// Of trials as they come by nature.
ShareBars fates_of(const ExperimentResult& result) {
  const std::vector<std::size_t> over = axes_of_rows(result.axes);
  const auto joined = [&](const auto& text_of) {
    std::vector<std::string> texts;
    for (const std::size_t i : over) texts.push_back(text_of(i));
    return texts.empty() ? "all" : fmt::format("{}", fmt::join(texts, ", "));
  };
  ShareBars bars{
      .title = "What became of the frames",
      .description = over.size() == result.axes.size()
                         ? "Share of frames by how far they came"
                         : "Share of frames by how far they came, all other values of the "
                           "sweep together",
      .rows_label = joined([&](std::size_t i) { return axis_name(result.axes[i]); }),
      .kinds = {std::begin(fates), std::end(fates)},
      .rows = {}};
  for (const PointResult& point : result.points) {
    if (!measured(point) || point.tally.is_weighted()) continue;
    ShareRow& row = row_of(bars.rows, joined([&](std::size_t i) {
                             return coordinate_text(result.axes[i], point.coordinates[i]);
                           }));
    std::ranges::transform(row.counts, fates_of(point.tally), row.counts.begin(), std::plus<>());
  }
  return bars;
}

PageTable table_of(const ShareBars& bars) {
  PageTable table{.head = {bars.rows_label}, .rows = {}};
  table.head.insert(table.head.end(), bars.kinds.begin(), bars.kinds.end());
  for (const ShareRow& row : bars.rows) {
    table.rows.push_back({row.label});
    for (const std::uint64_t count : row.counts) table.rows.back().push_back(std::to_string(count));
  }
  return table;
}

PageSection fates_section(const ExperimentResult& result, const std::string& of) {
  PageSection section{.heading = "What became of the frames" + of,
                      .text = loss_reasons(result) + mark_notes(result)};
  const ShareBars bars = fates_of(result);
  if (bars.rows.empty()) return section;
  section.picture = {"fates", bars.description, share_bars_as_svg(bars)};
  section.table = table_of(bars);
  return section;
}

PageTable table_of(const Omissions& omissions) {
  PageTable table{.head = {"without", "frames", "lost", "FLR"}, .rows = {}};
  for (const Omission& o : omissions.omissions)
    table.rows.push_back({o.without.empty() ? "nothing: the link as it is" : o.without,
                          std::to_string(o.tally.n_frames), std::to_string(o.tally.n_frames_lost),
                          estimate_text(frame_loss_ratio(o.tally, 0.95))});
  return table;
}

PageSection limits_section(const Omissions& omissions, const std::string& of) {
  return {.heading = "What limits it" + of,
          .text = fmt::format("The point where it fails{}, run again without one thing at a time.",
                              omissions.place.empty() ? "" : ", " + omissions.place),
          .table = table_of(omissions)};
}

PageTable table_of(const HeatMap& map) {
  PageTable table{.head = {map.y_label + " \\ " + map.x_label}, .rows = {}};
  table.head.insert(table.head.end(), map.columns.begin(), map.columns.end());
  for (std::size_t r = 0; r < map.rows.size(); ++r) {
    table.rows.push_back({map.rows[r]});
    for (const double value : map.values[r])
      table.rows.back().push_back(std::isnan(value) ? "-" : fmt::format("{:.2g}", value));
  }
  return table;
}

void add_maps(Page& page, const ReportedResult& reported, bool alone) {
  for (const HeatMap& map : result_maps(reported.result))
    page.sections.push_back(
        {.heading = map.title + (alone ? std::string() : " of " + reported.name),
         .picture = PagePicture{"frame-loss-map", map.description, heat_map_as_svg(map)},
         .table = table_of(map)});
}

void add_ranking(Page& page, const ReportedResult& reported, bool alone) {
  const Ranking ranking = rank(reported.result);
  if (ranking.rows.size() > 1)
    page.sections.push_back(
        {.heading = "How far each reaches" + (alone ? std::string() : " of " + reported.name),
         .preformatted = ranking_lines(reported.result, ranking)});
}

PageSection trial_section(const TracedTrial& trial, const std::string& of) {
  const std::string which =
      fmt::format("Trial {} of point {}", trial.origin.trial, trial.origin.point);
  return {
      .heading = which + of,
      .text =
          "Every tap of the receiver on one time axis, in ms since the message began: zoom and "
          "pan in any of them. Above the light what was sent, along the pin what was read; what "
          "was misread is marked.",
      .trial =
          PageTrial{view_of(trial),
                    {"trial", which + ": light above the decoded line", trace_as_picture(trial)}}};
}

void add_wrong_bits(Page& page, const ShownTrial& shown, const std::string& of) {
  if (shown.wrong.bursts.empty()) return;
  const HeatMap map = wrong_bits_map(shown);
  page.sections.push_back(
      {.heading = map.title + of,
       .picture = PagePicture{"wrong-bits", map.description, heat_map_as_svg(map)},
       .table = table_of(map)});
  page.sections.push_back(chart_section(burst_chart(shown), of));
}

PagePicture eye_of(const ShownTrial& shown) {
  return {"eye", "The integrator over two bits, all bits of the message over each other",
          eye_as_svg(shown)};
}

void add_trial(Page& page, const ShownTrial& shown, const std::string& of) {
  page.sections.push_back(trial_section(shown.trial, of));
  if (!shown.trial.taps.integrator.empty() && !channel::is_matched(shown.module))
    page.sections.push_back({.heading = "Eye diagram" + of, .picture = eye_of(shown)});
  add_wrong_bits(page, shown, of);
  page.sections.push_back(chart_section(jitter_chart(shown), of));
  page.sections.push_back(chart_section(spectrum_chart(shown), of));
}

void add_result(Page& page, const ReportedResult& reported, bool alone) {
  const ExperimentResult& result = reported.result;
  const std::string of = alone ? "" : " of " + reported.name;
  page.sections.push_back(fates_section(result, of));
  if (reported.omissions.omissions.size() > 1)
    page.sections.push_back(limits_section(reported.omissions, of));
  if (reported.trial) add_trial(page, *reported.trial, of);
  page.sections.push_back({.heading = "All numbers" + of, .table = table_of(result)});
  page.sections.push_back({.heading = "The scenario" + of,
                           .text = "To repeat it: " + result.command,
                           .preformatted = result.scenario_toml});
}

}  // namespace

Page report_of(const std::vector<ReportedResult>& results) {
  Page page{.title = title_of(results.front()), .verdict = {}, .sections = {}};
  for (const ReportedResult& reported : results)
    page.verdict += (results.size() > 1 ? reported.name + ": " : "") +
                    verdict_of(reported.result, reported.omissions);
  for (const ReportedResult& reported : results) add_ranking(page, reported, results.size() == 1);
  for (Chart& chart : charts_of(results))
    page.sections.push_back(chart_section(std::move(chart), ""));
  for (const ReportedResult& reported : results) add_maps(page, reported, results.size() == 1);
  for (const ReportedResult& reported : results) add_result(page, reported, results.size() == 1);
  return page;
}

}  // namespace sim
