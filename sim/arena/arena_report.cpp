#include "sim/arena/arena_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "sim/arena/arena_columns.hpp"
#include "sim/arena/trajectory.hpp"
#include "sim/columns/columns_table.hpp"
#include "sim/columns/text_table.hpp"
#include "sim/loading/point_scenario.hpp"

namespace sim {
namespace {

// ---- devices by their kinds ----

struct KindRow {
  std::string label;  // "charger", "charger x12"
  SenderTally tally{};
  std::uint64_t devices = 0, runs = 0;
  double highest_irradiance = 0;
};

std::vector<KindRow> kinds_of(const ArenaPoint& point) {
  std::map<std::string, KindRow> kinds;
  for (std::size_t i = 0; i < point.senders.size(); ++i) {
    KindRow& row = kinds[point.senders[i].kind];
    row.tally += point.tally.senders[i];
    row.runs += point.tally.n_runs;
    ++row.devices;
    row.highest_irradiance = std::max(row.highest_irradiance, point.senders[i].highest_irradiance);
  }
  std::vector<KindRow> rows;
  for (auto& [kind, row] : kinds) {
    row.label = row.devices > 1 ? fmt::format("{} x{}", kind, row.devices) : kind;
    rows.push_back(std::move(row));
  }
  return rows;
}

Columns<KindRow> kind_columns() {
  Columns<KindRow> columns;
  columns.words({}, [](const KindRow& row) { return row.label; }).headed({{"", "", "device"}, -6});
  columns.real({}, [](const KindRow& row) { return row.highest_irradiance; })
      .headed({{"", "irradiance", "[mW/m2]"}, 10});
  add_message_columns(columns, {}, [](const KindRow& row) { return row.tally; });
  columns
      .words({},
             [](const KindRow& row) {
               return fmt::format("{}/{}", row.tally.latency.n_runs_heard, row.runs);
             })
      .headed({{"", "heard in", "runs"}, 8});
  columns
      .real(
          {}, [](const KindRow& row) { return row.tally.latency.mean_s(); }, significant(3))
      .headed({{"", "first after", "[s]"}, 11});
  return columns;
}

// ---- along the way ----

constexpr std::size_t stretches = 10;

const std::vector<TextColumn>& way_columns() {
  static const std::vector<TextColumn> columns{
      {{"", "time", "[s]"}, 13},     {{"", "x", "[m]"}, 6},        {{"", "y", "[m]"}, 6},
      {{"", "heading", "[deg]"}, 7}, {{"", "frames", "a run"}, 7}, {{"", "", "heard"}, -1}};
  return columns;
}

/// Devices heard, those heard most first: "charger 12, gate 3".
std::string heard_text(const std::map<std::string, std::uint64_t>& counts) {
  constexpr std::size_t most = 6;
  std::vector<std::pair<std::string, std::uint64_t>> sorted(counts.begin(), counts.end());
  std::ranges::stable_sort(sorted, std::ranges::greater{},
                           [](const auto& one) { return one.second; });
  std::string text;
  for (std::size_t i = 0; i < std::min(sorted.size(), most); ++i)
    text += fmt::format("{}{} {}", i == 0 ? "" : ", ", sorted[i].first, sorted[i].second);
  if (sorted.size() > most) text += fmt::format(" and {} more", sorted.size() - most);
  return text.empty() ? "nothing" : text;
}

std::string way_row(const ArenaPoint& point, const Trajectory& way, std::size_t stretch) {
  const double length = point.duration_s / stretches;
  const double from = length * static_cast<double>(stretch), to = from + length;
  std::map<std::string, std::uint64_t> counts;
  std::uint64_t frames = 0;
  for (const HeardFrame& heard : point.heard) {
    if (heard.start_s < from || heard.start_s >= to) continue;
    ++counts[point.senders[heard.sender].name];
    ++frames;
  }
  const Pose2D place = way.at(dsp::Seconds((from + to) / 2));
  return table_line(
      way_columns(),
      {fmt::format("{:.1f} .. {:.1f}", from, to), fmt::format("{:.2f}", place.x),
       fmt::format("{:.2f}", place.y),
       fmt::format("{:.0f}", std::remainder(place.heading.value / dsp::degrees(1).value, 360.0)),
       fmt::format("{:.1f}", static_cast<double>(frames) / static_cast<double>(point.tally.n_runs)),
       heard_text(counts)});
}

/// What there is to say of one point more than its row.
std::string details(const LoadedScenario& scenario, const ArenaPoint& point) {
  const SenderTally all = together(point);
  std::string text = row_table(kind_columns(), kinds_of(point)) + "\n" +
                     waterfall(all.messages(), loss_stages(all), "delivered");
  if (point.tally.n_false > 0)
    text += fmt::format("{:>10}  accepted though nobody sent them\n", point.tally.n_false);
  return text + "\n" + way_table(point_scenario(scenario, point.coordinates), point);
}

}  // namespace

std::vector<LossStage> loss_stages(const SenderTally& tally) {
  std::vector<LossStage> stages;
  for (std::size_t i = 1; i < loss_causes; ++i)
    stages.push_back({loss_cause_names[i].words, tally.by_cause[i]});
  return stages;
}

std::string waterfall(std::uint64_t messages, const std::vector<LossStage>& stages,
                      std::string_view end) {
  std::string lines = fmt::format("{:>10}  messages\n", messages);
  std::uint64_t left = messages;
  for (const LossStage& stage : stages) {
    left -= stage.lost;
    const double share =
        messages > 0 ? static_cast<double>(stage.lost) / static_cast<double>(messages) : 0;
    lines += fmt::format("{:>10}  {:<24} {:>6.2f} %   {:>10} left\n",
                         fmt::format("-{}", stage.lost), stage.words, 100 * share, left);
  }
  return lines + fmt::format("{:>10}  {}\n", left, end);
}

std::string way_table(const Scenario& scenario, const ArenaPoint& point) {
  const Trajectory way(scenario.path);
  std::string table = table_head(way_columns());
  for (std::size_t i = 0; i < stretches; ++i) table += way_row(point, way, i);
  return table;
}

constinit const PointReport<ArenaPoint> arena_report{arena_columns, details};

}  // namespace sim
