#include "sim/arena/arena_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "sim/arena/way.hpp"
#include "sim/counting/statistics.hpp"
#include "sim/report/estimate_text.hpp"
#include "sim/report/outside_report.hpp"
#include "sim/report/text_table.hpp"

namespace sim {
namespace {

std::string share(double value) { return std::isnan(value) ? "-" : fmt::format("{:.4f}", value); }

std::string seconds(double value) { return std::isnan(value) ? "-" : fmt::format("{:.3g}", value); }

// ---- a row a point ----

std::vector<TextColumn> point_columns(const std::vector<Axis>& axes) {
  std::vector<TextColumn> columns = axis_columns(axes);
  columns.push_back({{"", "", "devices"}, 7});
  columns.push_back({{"", "messages", "sent"}, 9});
  columns.push_back({{"", "", "in reach"}, 9});
  columns.push_back({{"", "", "overlapped"}, 10});
  columns.push_back({{"", "", "captured"}, 9});
  columns.push_back({{"", "", "delivered"}, 9});
  columns.push_back({{"", "frame loss ratio", "[interval]"}, -estimate_width});
  columns.push_back({{"", "first after", "[s]"}, 11});
  columns.push_back({{"offered", "load", "G"}, 7});
  columns.push_back({{"through-", "put", "S"}, 8});
  columns.push_back({{"pure", "ALOHA", "S"}, 7});
  columns.push_back(outside_column());
  return columns;
}

// ---- devices ----

std::vector<TextColumn> device_columns(std::size_t name_width) {
  return {{{"", "", "device"}, -static_cast<int>(std::max<std::size_t>(name_width, 6))},
          {{"", "irradiance", "[mW/m2]"}, 10},
          {{"", "messages", "sent"}, 9},
          {{"", "", "in reach"}, 9},
          {{"", "", "overlapped"}, 10},
          {{"", "", "captured"}, 9},
          {{"", "", "delivered"}, 9},
          {{"", "frame loss ratio", "[interval]"}, -estimate_width},
          {{"", "heard in", "runs"}, 8},
          {{"", "first after", "[s]"}, 11}};
}

/// Devices of one kind.
struct KindRow {
  SenderTally tally;
  std::uint64_t devices = 0;
  double highest_irradiance = 0;
};

std::map<std::string, KindRow> kinds_of(const ArenaPoint& point) {
  std::map<std::string, KindRow> kinds;
  for (std::size_t i = 0; i < point.senders.size(); ++i) {
    KindRow& row = kinds[point.senders[i].kind];
    row.tally += point.tally.senders[i];
    ++row.devices;
    row.highest_irradiance = std::max(row.highest_irradiance, point.senders[i].highest_irradiance);
  }
  return kinds;
}

std::vector<std::string> counts_of(const SenderTally& tally) {
  return {fmt::format("{}", tally.sent()),
          fmt::format("{}", tally.n_in_reach),
          fmt::format("{}", tally.n_overlapped),
          fmt::format("{}", tally.n_captured),
          fmt::format("{}", tally[FrameFate::delivered]),
          estimate_text(frame_loss(tally))};
}

std::string device_row(const std::vector<TextColumn>& columns, const std::string& name,
                       const KindRow& row, std::uint64_t runs) {
  std::vector<std::string> texts{name, fmt::format("{:.4g}", row.highest_irradiance)};
  for (std::string& text : counts_of(row.tally)) texts.push_back(std::move(text));
  texts.push_back(fmt::format("{}/{}", row.tally.latency.n_runs_heard, runs * row.devices));
  texts.push_back(seconds(row.tally.latency.mean_s()));
  return table_line(columns, texts);
}

std::string label_of(const std::string& kind, const KindRow& row) {
  return row.devices > 1 ? fmt::format("{} x{}", kind, row.devices) : kind;
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

std::string way_row(const ArenaPoint& point, const Way& way, std::size_t stretch) {
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

}  // namespace

std::string arena_header(const LoadedScenario& scenario) {
  return table_head(point_columns(scenario.sweep));
}

std::string arena_row(const LoadedScenario& scenario, const ArenaPoint& point) {
  const SenderTally all = together(point);
  std::vector<std::string> texts = coordinate_texts(scenario.sweep, point.coordinates);
  texts.push_back(fmt::format("{}", point.senders.size()));
  for (std::string& text : counts_of(all)) texts.push_back(std::move(text));
  texts.push_back(seconds(point.tally.any.mean_s()));
  const double load = offered_load(point, all);
  for (const double value : {load, throughput(point, all), pure_aloha(load)})
    texts.push_back(share(value));
  texts.push_back(outside_mark(point.outside));
  return table_line(point_columns(scenario.sweep), texts);
}

std::string device_table(const ArenaPoint& point) {
  const auto kinds = kinds_of(point);
  std::size_t width = 0;
  for (const auto& [name, row] : kinds) width = std::max(width, label_of(name, row).size());
  const auto columns = device_columns(width);
  std::string table = table_head(columns);
  for (const auto& [name, row] : kinds)
    table += device_row(columns, label_of(name, row), row, point.tally.n_runs);
  return table;
}

std::vector<LossStage> loss_stages(const SenderTally& tally) {
  std::vector<LossStage> stages;
  for (std::size_t i = 1; i < frame_fates; ++i)
    stages.push_back({fate_names[i].words, tally.fate[i]});
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
  const Way way(scenario.path);
  std::string table = table_head(way_columns());
  for (std::size_t i = 0; i < stretches; ++i) table += way_row(point, way, i);
  return table;
}

}  // namespace sim
