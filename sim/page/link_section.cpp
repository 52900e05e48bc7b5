#include "sim/page/link_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "sim/columns/estimate_text.hpp"
#include "sim/counting/statistics.hpp"
#include "sim/link_experiment/link_charts.hpp"
#include "sim/link_experiment/link_notes.hpp"
#include "sim/page/eye_diagram.hpp"
#include "sim/page/frame_charts.hpp"
#include "sim/page/link_range_section.hpp"
#include "sim/page/numbers_section.hpp"
#include "sim/page/scene_section.hpp"
#include "sim/page/setup_words.hpp"
#include "sim/page/summary.hpp"
#include "sim/page/trial_tables.hpp"
#include "sim/page/trial_view.hpp"
#include "sim/page/unit_section.hpp"
#include "sim/picture/svg.hpp"
#include "sim/result/place_text.hpp"
#include "sim/result/ranking.hpp"
#include "sim/section/picture_sections.hpp"
#include "sim/section/swept_curves.hpp"
#include "sim/section/swept_rows.hpp"
#include "sim/trace/trace_picture.hpp"

namespace sim {
namespace {

const char* const fates[] = {"delivered", "a line was heard, but not the one sent",
                             "characters were heard, but no line ended", "nothing was heard"};

std::vector<std::uint64_t> fates_of(const Tally& t) {
  return {t.n_frames - t.n_frames_lost, t.n_frames_lost - t.n_frames_unended - t.n_frames_unheard,
          t.n_frames_unended, t.n_frames_unheard};
}

/// Of trials as they come by nature.
ShareBars fates_of(const LinkResult& result) {
  const SweptRows rows(result.axes);
  ShareBars bars{.title = "What became of the frames",
                 .description = rows.joins_points()
                                    ? "Share of frames by how far they came, of all other values "
                                      "of the sweep together: each point weighs the same"
                                    : "Share of frames by how far they came",
                 .rows_label = rows.head(),
                 .are_shares = rows.joins_points(),
                 .kinds = {std::begin(fates), std::end(fates)},
                 .rows = {}};
  for (const LinkPoint& point : result.points)
    if (point.reached() && !point.tally.is_weighted())
      add_counts(bars, rows.label(point.coordinates), rows.weighed(fates_of(point.tally)));
  return bars;
}

PageSection fates_section(const LinkResult& result) {
  const ShareBars bars = fates_of(result);
  PageSection section =
      bars.rows.empty() ? PageSection{.heading = bars.title} : shares_section("fates", bars);
  section.text = loss_reasons(result);
  return section;
}

PageTable link_table(const Ablations& ablations) {
  PageTable table{.head = {"the link", "frames", "lost", "FLR"}, .rows = {}};
  if (ablations.along) table.head.push_back("half lost at " + axis_name(*ablations.along));
  for (const Ablation& o : ablations.ablations) {
    table.rows.push_back({o.change.empty() ? "as it is" : o.change,
                          std::to_string(o.tally.n_frames), std::to_string(o.tally.n_frames_lost),
                          estimate_text(frame_loss_ratio(o.tally, 0.95))});
    if (ablations.along) table.rows.back().push_back(o.half ? half_loss_text(*o.half) : "-");
  }
  return table;
}

PageSection limits_section(const Ablations& ablations) {
  return {.heading = "What limits it",
          .text = fmt::format("The point where it fails{}, run again without one thing at a time.",
                              ablations.place.empty() ? "" : ", " + ablations.place),
          .table = link_table(ablations)};
}

/// More curves than have a colour hide each other: a map of them is looked at first.
bool hide_each_other(const Chart& chart) {
  const auto theories = std::ranges::count(chart.curves, CurveKind::theory, &ChartCurve::kind);
  return chart.curves.size() > most_coloured + static_cast<std::size_t>(theories);
}

void add_maps(ReportSection& report, const LinkResult& result) {
  const bool come_first = std::ranges::any_of(report.charts, hide_each_other);
  for (const HeatMap& map : result_maps(result))
    (come_first ? report.first : report.sections).push_back(map_section("frame-loss-map", map));
}

void add_ranking(ReportSection& report, const LinkResult& result, const Ranking& ranking) {
  report.link_ranges = link_ranges_of(result, ranking);
  const bool is_known = ranking.rows.size() == 1 && !ranking.rows.front().doubt;
  if (!ranking.rows.empty() && !is_known)
    report.first.push_back(link_range_section(result, ranking));
}

void add_units(ReportSection& report, const UnitSpread& spread,
               const std::vector<NumberEffect>& effects) {
  if (!effects.empty()) report.first.push_back(effects_section(spread, effects));
  report.first.push_back(units_section(spread));
}

PageSection trial_section(const LinkResult& result, const ShownTrial& shown) {
  const TracedTrial& trial = shown.trial;
  const std::string which =
      fmt::format("Trial {} of point {}", trial.origin.trial, trial.origin.point);
  const std::string place = place_text(result.axes, result.points[trial.origin.point].coordinates);
  return {
      .heading = which,
      .text =
          (place.empty() ? "" : "At " + place + ". ") +
          "Every tap of the receiver on one time axis, in ms since the message began: zoom and "
          "pan in any of them. Above the light what was sent, along the pin what was read; what "
          "was misread is marked." +
          (channel::is_matched(shown.module) ? " This receiver decides at the end of a bit: its "
                                               "pin is a bit later than the light."
                                             : ""),
      .trial = PageTrial{view_json(view_of(trial)),
                         {"trial", which + ": every tap of the receiver", taps_as_picture(trial)}},
      .table = characters_table(trial)};
}

void add_wrong_bits(ReportSection& report, const FrameStatistics& frames) {
  if (frames.wrong.bursts.empty()) return;
  report.sections.push_back(map_section("wrong-bits", wrong_bits_map(frames)));
  report.sections.push_back(chart_section(settling_chart(frames)));
  report.sections.push_back(bursts_section(frames));
}

void add_frames(ReportSection& report, const FrameStatistics& frames) {
  add_wrong_bits(report, frames);
  if (frames.delays.falling_us.empty() || frames.delays.rising_us.empty()) return;
  report.sections.push_back(chart_section(jitter_chart(frames)));
  report.sections.back().text = delays_text(frames);
}

void add_shown_trial(ReportSection& report, const LinkResult& result, const ShownTrial& shown) {
  report.sections.push_back(trial_section(result, shown));
  if (!shown.trial.taps.integrator.empty() && !channel::is_matched(shown.module))
    report.sections.push_back(
        {.heading = "Eye diagram", .picture = eye_picture(shown), .table = eye_table(shown.trial)});
  report.sections.push_back(chart_section(spectrum_chart(shown)));
}

}  // namespace

ReportSection link_section(const LinkReport& link) {
  const LinkResult& result = link.result;
  ReportSection report{link.name, result.title,
                       answer_of(result, link.ranking) + setup_words(link.settings) +
                           summary_of(result, link.ablations) + marked_points(result)};
  report.settings = link.settings;
  report.scenario = scenario_section(result.command, result.scenario_toml);
  if (const auto units = unit_spread(result))
    add_units(report, *units, link.effects);
  else
    add_ranking(report, result, link.ranking);
  if (auto scene = scene_section(link.settings)) report.first.push_back(std::move(*scene));
  const LinkResult drawn = best_first(result, link.ranking);
  report.charts = result_charts(drawn);
  add_maps(report, drawn);
  report.sections.push_back(fates_section(result));
  report.sections.back().text += link.why_no_trial;
  if (link.ablations.ablations.size() > 1)
    report.sections.push_back(limits_section(link.ablations));
  if (link.trial) add_shown_trial(report, result, *link.trial);
  add_frames(report, link.frames);
  report.sections.push_back(numbers_section(result));
  return report;
}

}  // namespace sim
