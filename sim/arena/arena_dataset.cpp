// Everything of an arena for files and programs.
#include <map>
#include <utility>

#include "sim/arena/arena_report.hpp"
#include "sim/report/outside_report.hpp"

namespace sim {
namespace {

using Variable = Dataset::Variable;

/// Names of all devices of all points, in the order in which they are met.
std::vector<std::string> sender_names(const std::vector<ArenaPoint>& points) {
  std::vector<std::string> names;
  std::map<std::string, bool> seen;
  for (const ArenaPoint& point : points)
    for (const SenderFacts& sender : point.senders)
      if (!std::exchange(seen[sender.name], true)) names.push_back(sender.name);
  return names;
}

/// Cells (point, device) of a variable; those of devices that a point has not stay as they are.
template <class T, class Read>
std::vector<T> by_device(const std::vector<ArenaPoint>& points, T nothing, Read read) {
  const std::vector<std::string> names = sender_names(points);
  std::map<std::string, std::size_t> place;
  for (std::size_t i = 0; i < names.size(); ++i) place[names[i]] = i;
  std::vector<T> cells(points.size() * names.size(), nothing);
  for (std::size_t p = 0; p < points.size(); ++p)
    for (std::size_t i = 0; i < points[p].tally.senders.size(); ++i)
      cells[p * names.size() + place[points[p].senders[i].name]] = static_cast<T>(read(p, i));
  return cells;
}

struct CountColumn {
  const char *name, *long_name;
  std::uint64_t (*read)(const SenderTally&);
};

const CountColumn count_columns[] = {
    {"n_messages", "messages that the device had to send",
     [](const SenderTally& t) { return t.messages(); }},
    {"n_in_reach", "messages sent with light in reach all through, or delivered without",
     [](const SenderTally& t) { return t.n_in_reach; }},
    {"n_overlapped", "of those, with another device in reach at the same time",
     [](const SenderTally& t) { return t.n_overlapped; }},
    {"n_captured", "of those, delivered all the same",
     [](const SenderTally& t) { return t.n_captured; }},
    {"n_runs_heard", "runs with a message delivered",
     [](const SenderTally& t) { return t.latency.n_runs_heard; }},
};

struct RealColumn {
  const char *name, *unit, *long_name;
  double (*read)(const ArenaPoint&, const SenderTally&);
};

const RealColumn reals[] = {
    {"frame_loss", "1", "messages sent and not delivered over those sent",
     [](const ArenaPoint&, const SenderTally& t) { return frame_loss(t).value; }},
    {"frame_loss_ci_low", "1", "lower end of its 95 % interval",
     [](const ArenaPoint&, const SenderTally& t) { return frame_loss(t).low; }},
    {"frame_loss_ci_high", "1", "upper end of its 95 % interval",
     [](const ArenaPoint&, const SenderTally& t) { return frame_loss(t).high; }},
    {"offered_load", "1", "share of time in which messages in reach are in the air", offered_load},
    {"throughput", "1", "share of time of messages delivered", throughput},
    {"latency_mean_s", "s", "mean time to the end of the first message delivered",
     [](const ArenaPoint&, const SenderTally& t) { return t.latency.mean_s(); }},
    {"latency_max_s", "s", "longest of those times",
     [](const ArenaPoint&, const SenderTally& t) { return t.latency.worst_s(); }},
};

void add_device_variables(Dataset& data, const std::vector<ArenaPoint>& points) {
  const auto tally = [&](std::size_t p, std::size_t i) -> const SenderTally& {
    return points[p].tally.senders[i];
  };
  for (const CountColumn& column : count_columns)
    add_device_counts(data, points, column.name, column.long_name,
                      [&](std::size_t p, std::size_t i) { return column.read(tally(p, i)); });
  for (std::size_t f = 0; f < frame_fates; ++f)
    add_device_counts(data, points, "n_" + std::string(fate_names[f].name),
                      "messages whose fate was: " + std::string(fate_names[f].words),
                      [&](std::size_t p, std::size_t i) { return tally(p, i).fate[f]; });
  for (const RealColumn& column : reals)
    add_device_reals(
        data, points, {column.name, column.unit, column.long_name},
        [&](std::size_t p, std::size_t i) { return column.read(points[p], tally(p, i)); });
  add_device_reals(
      data, points, {"irradiance_mw_per_m2", "mW/m2", "highest irradiance along the way"},
      [&](std::size_t p, std::size_t i) { return points[p].senders[i].highest_irradiance; });
}

template <class T, class Read>
void add_point_variable(Dataset& data, const std::vector<ArenaPoint>& points, VariableFacts facts,
                        Read read) {
  std::vector<T> values;
  for (const ArenaPoint& point : points) values.push_back(static_cast<T>(read(point)));
  data.variables.push_back({std::move(facts), true, {}, std::move(values)});
}

void add_sums(Dataset& data, const std::vector<ArenaPoint>& points) {
  using Count = std::int64_t;
  const auto known = [](const ArenaPoint& p, double value) {
    return p.tally.n_runs > 0 ? value : unset;
  };
  add_point_variable<Count>(data, points, {"n_runs", "1", "runs"},
                            [](const ArenaPoint& p) { return p.tally.n_runs; });
  add_point_variable<Count>(data, points, {"n_devices", "1", "devices"},
                            [](const ArenaPoint& p) { return p.senders.size(); });
  add_point_variable<Count>(data, points, {"n_frames_false", "1", "frames accepted, none sent"},
                            [](const ArenaPoint& p) { return p.tally.n_false; });
  add_point_variable<double>(data, points, {"total_frame_loss", "1", "of all devices together"},
                             [](const ArenaPoint& p) { return frame_loss(together(p)).value; });
  add_point_variable<double>(data, points,
                             {"total_frame_loss_ci_low", "1", "lower end of its 95 % interval"},
                             [](const ArenaPoint& p) { return frame_loss(together(p)).low; });
  add_point_variable<double>(data, points,
                             {"total_frame_loss_ci_high", "1", "upper end of its 95 % interval"},
                             [](const ArenaPoint& p) { return frame_loss(together(p)).high; });
  add_point_variable<double>(
      data, points, {"total_offered_load", "1", "offered load of all devices together"},
      [&](const ArenaPoint& p) { return known(p, offered_load(p, together(p))); });
  add_point_variable<double>(
      data, points, {"total_throughput", "1", "throughput of all devices together"},
      [&](const ArenaPoint& p) { return known(p, throughput(p, together(p))); });
  add_point_variable<double>(
      data, points, {"pure_aloha_throughput", "1", "throughput of pure ALOHA at that load"},
      [&](const ArenaPoint& p) { return known(p, pure_aloha(offered_load(p, together(p)))); });
  add_point_variable<Count>(data, points, {"total_runs_heard", "1", "runs with any delivered"},
                            [](const ArenaPoint& p) { return p.tally.any.n_runs_heard; });
  add_point_variable<double>(
      data, points, {"total_latency_mean_s", "s", "mean time to the end of the first of all"},
      [](const ArenaPoint& p) { return p.tally.any.mean_s(); });
  add_point_variable<double>(data, points, {"total_latency_max_s", "s", "longest of those times"},
                             [](const ArenaPoint& p) { return p.tally.any.worst_s(); });
  std::vector<std::int64_t> outside;
  for (const ArenaPoint& p : points) outside.push_back(static_cast<std::int64_t>(p.outside));
  data.variables.push_back(outside_variable(std::move(outside)));
}

/// One frame that was heard after the other, of all points.
template <class T, class Read>
void add_heard_variable(Dataset& data, const std::vector<ArenaPoint>& points, VariableFacts facts,
                        Read read) {
  std::vector<T> values;
  for (std::size_t p = 0; p < points.size(); ++p)
    for (const HeardFrame& heard : points[p].heard)
      values.push_back(static_cast<T>(read(p, heard)));
  data.variables.push_back({std::move(facts), false, {"heard"}, std::move(values)});
}

/// Indices of texts in a list without repetition.
struct TextIndex {
  std::vector<std::string> texts;
  std::map<std::string, std::size_t> places;
  std::size_t operator[](const std::string& text) {
    const auto [at, added] = places.emplace(text, texts.size());
    if (added) texts.push_back(text);
    return at->second;
  }
};

void add_heard(Dataset& data, const std::vector<ArenaPoint>& points,
               const std::vector<std::string>& names) {
  using Count = std::int64_t;
  TextIndex devices;
  for (const std::string& name : names) devices[name];
  TextIndex messages;
  std::size_t n = 0;
  for (const ArenaPoint& point : points) n += point.heard.size();
  if (n == 0) return;
  std::vector<double> numbers(n);
  for (std::size_t i = 0; i < n; ++i) numbers[i] = static_cast<double>(i);
  data.dimensions.push_back({{"heard", "1", "frames delivered, by point, run and time"}, numbers});
  add_heard_variable<Count>(data, points, {"heard_point", "1", "point of the sweep"},
                            [](std::size_t p, const HeardFrame&) { return p; });
  add_heard_variable<Count>(data, points, {"heard_run", "1", "run"},
                            [](std::size_t, const HeardFrame& h) { return h.run; });
  add_heard_variable<Count>(data, points, {"heard_device", "1", "index in device"},
                            [&](std::size_t p, const HeardFrame& h) {
                              return devices[points[p].senders[h.sender].name];
                            });
  add_heard_variable<Count>(data, points, {"heard_message", "1", "index in message"},
                            [&](std::size_t, const HeardFrame& h) { return messages[h.message]; });
  add_heard_variable<double>(data, points, {"heard_start_s", "s", "start of the message"},
                             [](std::size_t, const HeardFrame& h) { return h.start_s; });
  add_heard_variable<double>(data, points, {"heard_end_s", "s", "end of the message"},
                             [](std::size_t, const HeardFrame& h) { return h.end_s; });
  add_heard_variable<double>(data, points, {"heard_x_m", "m", "place of the receiver then"},
                             [](std::size_t, const HeardFrame& h) { return h.x_m; });
  add_heard_variable<double>(data, points, {"heard_y_m", "m", "place of the receiver then"},
                             [](std::size_t, const HeardFrame& h) { return h.y_m; });
  data.dimensions.push_back(
      {{"message", "", "device messages that were delivered"}, messages.texts});
}

}  // namespace

void add_device_counts(Dataset& data, const std::vector<ArenaPoint>& points,
                       const std::string& name, const std::string& long_name,
                       const std::function<std::uint64_t(std::size_t, std::size_t)>& read) {
  if (sender_names(points).empty()) return;
  data.variables.push_back(
      {{name, "1", long_name}, true, {"device"}, by_device<std::int64_t>(points, 0, read)});
}

void add_device_reals(Dataset& data, const std::vector<ArenaPoint>& points,
                      const VariableFacts& facts,
                      const std::function<double(std::size_t, std::size_t)>& read) {
  if (sender_names(points).empty()) return;
  data.variables.push_back({facts, true, {"device"}, by_device<double>(points, unset, read)});
}

Dataset arena_dataset(const LoadedScenario& scenario, const std::string& command,
                      const std::vector<ArenaPoint>& points) {
  Dataset data = dataset_of(scenario, command);
  const std::vector<std::string> names = sender_names(points);
  if (!names.empty()) data.dimensions.push_back({{"device", "", "devices"}, names});
  for (const ArenaPoint& point : points) data.n_runs += point.tally.n_runs;
  add_sums(data, points);
  add_device_variables(data, points);
  add_heard(data, points, names);
  return data;
}

}  // namespace sim
