#include "sim/guard/guard_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/arena/arena_report.hpp"
#include "sim/report/outside_report.hpp"
#include "sim/report/text_table.hpp"

namespace sim {
namespace {

constexpr double high_share = 0.95;

std::string seconds(double value) { return std::isnan(value) ? "-" : fmt::format("{:.2f}", value); }

void add_age_columns(std::vector<TextColumn>& columns) {
  columns.push_back({{"mean age", "at base", "[s]"}, 8});
  columns.push_back({{"95 % of", "ages", "[s]"}, 8});
  columns.push_back({{"nothing", "known", ""}, 8});
}

void add_ages(std::vector<std::string>& texts, const AgeCounts& age) {
  texts.push_back(seconds(age.mean_s()));
  texts.push_back(seconds(age.quantile_s(high_share)));
  texts.push_back(percent_text(age.unknown_share()));
}

std::vector<TextColumn> point_columns(const std::vector<Axis>& axes) {
  std::vector<TextColumn> columns = axis_columns(axes);
  columns.push_back({{"", "", "messages"}, 9});
  columns.push_back({{"heard by", "the", "guard"}, 9});
  columns.push_back({{"known", "to the", "base"}, 9});
  add_age_columns(columns);
  columns.push_back({{"questions", "", "asked"}, 9});
  columns.push_back({{"", "", "answered"}, 9});
  columns.push_back({{"", "timed", "out"}, 9});
  columns.push_back(outside_column());
  return columns;
}

/// Of all devices of a point together.
void add_total_ages(Dataset& data, const std::vector<GuardPoint>& points) {
  std::vector<double> means, p95s, unknown;
  for (const GuardPoint& point : points) {
    const AgeCounts age = together(point).age;
    means.push_back(age.mean_s());
    p95s.push_back(age.quantile_s(high_share));
    unknown.push_back(age.unknown_share());
  }
  const auto add = [&](VariableFacts facts, std::vector<double> values) {
    data.variables.push_back({std::move(facts), true, {}, std::move(values)});
  };
  add({"total_age_mean_s", "s", "age_mean_s of all devices together"}, std::move(means));
  add({"total_age_p95_s", "s", "age_p95_s of all devices together"}, std::move(p95s));
  add({"total_unknown_share", "1", "unknown_share of all devices together"}, std::move(unknown));
}

std::vector<TextColumn> device_columns(std::size_t name_width) {
  std::vector<TextColumn> columns{
      {{"", "", "device"}, -static_cast<int>(std::max<std::size_t>(name_width, 6))},
      {{"", "", "variable"}, -8},
      {{"", "", "messages"}, 9},
      {{"heard by", "the", "guard"}, 9},
      {{"known", "to the", "base"}, 9}};
  add_age_columns(columns);
  return columns;
}

}  // namespace

std::string percent_text(double share) {
  return std::isnan(share) ? "-" : fmt::format("{:.1f} %", 100 * share);
}

std::string guard_header(const LoadedScenario& scenario) {
  return table_head(point_columns(scenario.sweep));
}

std::string guard_row(const LoadedScenario& scenario, const GuardPoint& point) {
  const SenderTally sent = together(point.arena);
  const MirrorTally mirror = together(point);
  std::vector<std::string> texts = coordinate_texts(scenario.sweep, point.arena.coordinates);
  for (const std::uint64_t n : {sent.messages(), sent[FrameFate::delivered], mirror.n_known})
    texts.push_back(fmt::format("{}", n));
  add_ages(texts, mirror.age);
  for (const std::uint64_t n :
       {point.tally.n_asked, point.tally.n_answered, point.tally.n_timed_out})
    texts.push_back(fmt::format("{}", n));
  texts.push_back(outside_mark(point.arena.outside));
  return table_line(point_columns(scenario.sweep), texts);
}

std::string mirror_table(const GuardPoint& point) {
  std::size_t width = 0;
  for (const SenderFacts& sender : point.arena.senders) width = std::max(width, sender.name.size());
  const auto columns = device_columns(width);
  std::string table = table_head(columns);
  for (std::size_t i = 0; i < point.variables.size(); ++i) {
    const SenderTally& sent = point.arena.tally.senders[i];
    const MirrorTally& mirror = point.tally.mirrors[i];
    std::vector<std::string> texts{point.arena.senders[i].name, point.variables[i]};
    for (const std::uint64_t n : {sent.messages(), sent[FrameFate::delivered], mirror.n_known})
      texts.push_back(fmt::format("{}", n));
    add_ages(texts, mirror.age);
    table += table_line(columns, texts);
  }
  return table;
}

std::string guard_waterfall(const GuardPoint& point) {
  const SenderTally sent = together(point.arena);
  const MirrorTally mirror = together(point);
  std::vector<LossStage> stages = loss_stages(sent);
  stages.push_back({"replaced by a newer one", mirror.n_replaced});
  stages.push_back({"SharedLink", mirror.n_lost});
  return waterfall(sent.messages(), stages, "known to the base station");
}

Dataset guard_dataset(const LoadedScenario& scenario, const std::string& command,
                      const std::vector<GuardPoint>& points) {
  std::vector<ArenaPoint> arenas;
  for (const GuardPoint& point : points) arenas.push_back(point.arena);
  Dataset data = arena_dataset(scenario, command, arenas);
  const auto mirror_of = [&](std::size_t point, std::size_t device) -> const MirrorTally& {
    return points[point].tally.mirrors[device];
  };
  add_device_counts(data, arenas, "n_replaced", "messages replaced before they were passed on",
                    [&](std::size_t p, std::size_t i) { return mirror_of(p, i).n_replaced; });
  add_device_counts(data, arenas, "n_sharedlink_lost", "messages lost between guard and base",
                    [&](std::size_t p, std::size_t i) { return mirror_of(p, i).n_lost; });
  add_device_counts(data, arenas, "n_known", "messages that the base station got to know",
                    [&](std::size_t p, std::size_t i) { return mirror_of(p, i).n_known; });
  add_device_reals(data, arenas, {"age_mean_s", "s", "mean age of what the base station knows"},
                   [&](std::size_t p, std::size_t i) { return mirror_of(p, i).age.mean_s(); });
  add_device_reals(
      data, arenas, {"age_p95_s", "s", "age that 95 % of the time is not exceeded"},
      [&](std::size_t p, std::size_t i) { return mirror_of(p, i).age.quantile_s(high_share); });
  add_device_reals(
      data, arenas, {"unknown_share", "1", "share of time in which nothing is known"},
      [&](std::size_t p, std::size_t i) { return mirror_of(p, i).age.unknown_share(); });
  add_total_ages(data, points);
  const std::pair<const char*, std::uint64_t GuardTally::*> counts[] = {
      {"n_shared_messages_sent", &GuardTally::n_sent},
      {"n_shared_messages_accepted", &GuardTally::n_accepted},
      {"n_queries", &GuardTally::n_asked},
      {"n_queries_answered", &GuardTally::n_answered},
      {"n_queries_timed_out", &GuardTally::n_timed_out}};
  for (const auto& [name, member] : counts) {
    std::vector<std::int64_t> values;
    for (const GuardPoint& point : points)
      values.push_back(static_cast<std::int64_t>(point.tally.*member));
    data.variables.push_back({{name, "1", "SharedLink between guard and base"}, true, {}, values});
  }
  return data;
}

}  // namespace sim
