#include "sim/arena/arena_section.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "sim/arena/arena_columns.hpp"
#include "sim/arena/arena_map.hpp"
#include "sim/arena/arena_sums.hpp"
#include "sim/arena/loss_cause.hpp"
#include "sim/scenario/sweep.hpp"
#include "sim/section/dataset_cells.hpp"
#include "sim/section/dataset_words.hpp"
#include "sim/section/experiment_section.hpp"
#include "sim/section/picture_sections.hpp"
#include "sim/section/swept_maps.hpp"

namespace sim {
namespace {

constexpr std::size_t most_maps = 6;

std::string size_of(const Dataset& data) {
  const double all = DatasetCells(data, "n_messages").sum();
  const double silent = DatasetCells(data, "n_silent").sum();
  return fmt::format(
      "{:.0f} messages were sent in {}; {:.0f} of them were delivered.{}\n", all - silent,
      runs_text(data), DatasetCells(data, "n_delivered").sum(),
      silent > 0 ? fmt::format(" {:.0f} more were left out in silent spells.", silent) : "");
}

/// "98", "2.1": two digits.
std::string percent(double share) {
  return fmt::format("{:.{}f}", 100 * share, share < 0.00995 ? 2 : share < 0.0995 ? 1 : 0);
}

/// What was lost, by what each cause has of it.
std::string causes_of(const Dataset& data) {
  std::vector<std::pair<double, std::string>> causes;
  double lost = 0;
  for (const LossCauseName& cause : loss_cause_names) {
    if (cause.name == "delivered" || cause.name == "silent") continue;
    causes.emplace_back(DatasetCells(data, fmt::format("n_{}", cause.name)).sum(), cause.words);
    lost += causes.back().first;
  }
  std::erase_if(causes, [](const auto& cause) { return cause.first == 0; });
  std::ranges::stable_sort(causes, std::greater<>(), [](const auto& cause) { return cause.first; });
  std::string text;
  for (const auto& [count, words] : causes)
    text += fmt::format("{}{} {} %", text.empty() ? "Of those lost: " : ", ", words,
                        percent(count / lost));
  return text.empty() ? text : text + ".\n";
}

/// How soon any device is heard; points where none ever is have no time.
std::string first_of_any(const Dataset& data) {
  const DatasetCells time(data, "total_latency_mean_s");
  std::size_t unheard = 0;
  for (const std::size_t point : measured_points(data))
    unheard += point < time.size() && std::isnan(time[point]);
  return extremes(data, "total_latency_mean_s", "The mean time until the first message is heard",
                  " s") +
         (unheard > 0 ? fmt::format("At {} of {} points none is ever heard.\n", unheard,
                                    measured_points(data).size())
                      : "");
}

/// Of a single point how soon each device is heard, the soonest first; of a sweep how soon any is.
std::string first_heard(const Dataset& data) {
  if (!data.axes.empty()) return first_of_any(data);
  constexpr std::size_t most = 8;
  const DatasetCells time(data, "latency_mean_s"), runs(data, "n_runs_heard");
  const Dataset::Dimension& devices = dimension_named(data, "device");
  if (time.size() != devices.size() || devices.size() > most) return "";
  std::vector<std::pair<double, std::string>> known;
  for (std::size_t i = 0; i < devices.size(); ++i)
    if (std::isfinite(time[i]))
      known.emplace_back(
          time[i], fmt::format("{} after {:.2g} s ({} of {} runs)", value_text(devices, i), time[i],
                               runs.text(i), data.n_runs));
  if (known.empty()) return "";
  std::ranges::stable_sort(known, {}, [](const auto& one) { return one.first; });
  std::vector<std::string> words;
  for (const auto& [after, text] : known) words.push_back(text);
  return fmt::format("First heard on average: {}.\n", fmt::join(words, ", "));
}

/// Rows of the devices where there is one point, else of the points.
ShareBars shares_of(const Dataset& data, const std::vector<CountedKind>& losses) {
  const char *title = "What became of the messages", *of = "messages by what became of them";
  return data.axes.empty() ? element_shares(data, title, of, losses)
                           : point_shares(data, title, of, losses);
}

/// Of a sweep its curves come first.
void add_maps(ReportSection& report, const StoredDataset& stored) {
  std::vector<PageSection>& sections = stored.data.axes.empty() ? report.first : report.sections;
  std::vector<std::size_t> points = measured_points(stored.data);
  const std::size_t all = points.size();
  points.resize(std::min(all, most_maps));
  for (const std::size_t point : points) sections.push_back(arena_map(stored, point));
  if (all > most_maps)
    sections.back().text += fmt::format(
        "\nOf {} points the first {} have a map; --set chooses others.", all, most_maps);
}

void add_arena_charts(ReportSection& report, const Dataset& data) {
  add_charts(report, data, drawn_columns(arena_columns()));
  const DatasetCells loss(data, "total_frame_loss");
  std::vector<MapValue> ratios;
  for (std::size_t i = 0; i < count_points(data.axes); ++i)
    ratios.push_back({loss[i], loss.text(i)});
  for (const HeatMap& map : swept_maps(data.axes, ratios, "Map of frame loss", "frame loss ratio"))
    report.sections.push_back(map_section("frame-loss-map", map));
}

MessageTables tables_of(const Dataset& data) {
  std::vector<std::string> devices{"irradiance_mw_per_m2"}, points{"n_runs", "n_devices"};
  add_message_columns(devices, "");
  devices.insert(devices.end(), {"n_runs_heard", "latency_mean_s"});
  add_message_columns(points, "total_");
  add_load_columns(points);
  const std::vector<ColumnFacts> columns = arena_columns().facts();
  return {arena_losses(), headed_columns(data, columns, devices),
          headed_columns(data, columns, points)};
}

}  // namespace

std::vector<CountedKind> arena_losses() {
  std::vector<CountedKind> losses;
  for (const LossCauseName& cause : loss_cause_names)
    losses.push_back({fmt::format("n_{}", cause.name), std::string(cause.words)});
  return losses;
}

void add_message_columns(std::vector<std::string>& names, const std::string& of) {
  for (const char* name :
       {"n_messages_sent", "n_in_reach", "n_overlapped", "n_captured", "n_delivered", "frame_loss"})
    names.push_back(of + name);
}

void add_load_columns(std::vector<std::string>& names) {
  names.insert(names.end(), {"total_latency_mean_s", "total_offered_load", "total_throughput",
                             "pure_aloha_throughput", "n_frames_false"});
}

ReportSection section_of_messages(const std::string& name, StoredDataset stored,
                                  const MessageTables& tables) {
  Dataset& data = stored.data;
  add_message_sums(data);
  ReportSection report{name, data.title, size_of(data)};
  report.summary += extremes(data, "total_frame_loss", "Frame loss") + causes_of(data) +
                    first_heard(data) + missing_points(stored);
  add_arena_charts(report, data);
  add_maps(report, stored);
  report.sections.push_back(shares_section("fates", shares_of(data, tables.losses)));
  report.sections.push_back(
      {.heading = "All devices", .table = dataset_table(data, tables.devices)});
  add_closing(report, data, tables.points);
  return report;
}

ReportSection arena_section(const std::string& name, const StoredDataset& stored) {
  ReportSection report = section_of_messages(name, stored, tables_of(stored.data));
  if (!stored.data.axes.empty())
    report.summary += extremes(stored.data, "total_throughput", "Throughput");
  return report;
}

}  // namespace sim
