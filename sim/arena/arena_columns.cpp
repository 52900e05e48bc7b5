#include "sim/arena/arena_columns.hpp"

#include <string>
#include <utility>
#include <vector>

#include "sim/columns/stop_column.hpp"
#include "sim/columns/validity_column.hpp"

namespace sim {
namespace {

using Point = ArenaPoint;

std::vector<Label> device_labels(const Point& point) {
  std::vector<Label> names;
  for (const SenderFacts& sender : point.senders) names.emplace_back(sender.name);
  return names;
}

// ---- all devices of a point together ----

void add_sums(Columns<Point>& columns) {
  columns.count({"n_runs", "1", "runs"}, [](const Point& p) { return p.tally.n_runs; });
  columns.count({"n_devices", "1", "devices"}, [](const Point& p) { return p.senders.size(); })
      .headed({{"", "", "devices"}, 7});
  add_message_columns(columns, {"total_frame_loss", "1", "of all devices together"},
                      [](const Point& p) { return together(p); })
      .drawn({"Frame loss", "frame loss ratio (FLR)", true});
  columns
      .count({"n_frames_false", "1", "frames accepted, none sent"},
             [](const Point& p) { return p.tally.n_false; })
      .called("accepted, never sent");
  columns.count({"total_runs_heard", "1", "runs with any delivered"},
                [](const Point& p) { return p.tally.any.n_runs_heard; });
}

void add_latency_and_load(Columns<Point>& columns) {
  columns
      .real(
          {"total_latency_mean_s", "s", "mean time to the end of the first of all"},
          [](const Point& p) { return p.tally.any.mean_s(); }, significant(3))
      .headed({{"", "first after", "[s]"}, 11});
  columns.real({"total_latency_max_s", "s", "longest of those times"},
               [](const Point& p) { return p.tally.any.worst_s(); });
  columns
      .real(
          {"total_offered_load", "1", "offered load of all devices together"},
          [](const Point& p) { return offered_load(p, together(p)); }, fixed(4))
      .headed({{"offered", "load", "G"}, 7})
      .spared_before(2);
  columns
      .real(
          {"total_throughput", "1", "throughput of all devices together"},
          [](const Point& p) { return throughput(p, together(p)); }, fixed(4))
      .headed({{"through-", "put", "S"}, 8})
      .spared_before(2)
      .drawn({"Throughput", "throughput S (dashed: of pure ALOHA at that load)", false,
              "pure_aloha_throughput"});
  columns
      .real(
          {"pure_aloha_throughput", "1", "throughput of pure ALOHA at that load"},
          [](const Point& p) { return pure_aloha(offered_load(p, together(p))); }, fixed(4))
      .headed({{"pure", "ALOHA", "S"}, 7})
      .spared_before(2);
}

// ---- devices ----

void add_device_counts(Columns<Point>& columns) {
  const auto count = [&](VariableFacts facts, auto read) -> Column<Point>& {
    return columns
        .count(std::move(facts),
               [read](const Point& p, std::size_t i) { return read(p.tally.senders[i]); })
        .on({"device"});
  };
  using T = SenderTally;
  count({"n_messages", "1", "messages that the device had to send"},
        [](const T& t) { return t.messages(); });
  count({"n_in_reach", "1", "messages sent with light in reach all through, or delivered without"},
        [](const T& t) { return t.n_in_reach; });
  count({"n_overlapped", "1", "of those, with another device in reach at the same time"},
        [](const T& t) { return t.n_overlapped; });
  count({"n_captured", "1", "of those, delivered all the same"},
        [](const T& t) { return t.n_captured; });
  count({"n_runs_heard", "1", "runs with a message delivered"}, [](const T& t) {
    return t.latency.n_runs_heard;
  }).called("heard in runs");
  for (std::size_t f = 0; f < loss_causes; ++f)
    count({"n_" + std::string(loss_cause_names[f].name), "1",
           "messages by what became of them: " + std::string(loss_cause_names[f].words)},
          [f](const T& t) { return t.by_cause[f]; });
}

void add_device_reals(Columns<Point>& columns) {
  const auto real = [&](VariableFacts facts,
                        double (*read)(const Point&, const SenderTally&)) -> Column<Point>& {
    return columns
        .real(std::move(facts),
              [read](const Point& p, std::size_t i) { return read(p, p.tally.senders[i]); })
        .on({"device"});
  };
  columns
      .ratio({"frame_loss", "1", "messages sent and not delivered over those sent"},
             [](const Point& p, std::size_t i) { return frame_loss(p.tally.senders[i]); })
      .on({"device"})
      .called("frame loss ratio");
  real({"offered_load", "1", "share of time in which messages in reach are in the air"},
       offered_load);
  real({"throughput", "1", "share of time of messages delivered"}, throughput);
  real({"latency_mean_s", "s", "mean time to the end of the first message delivered"},
       [](const Point&, const SenderTally& t) { return t.latency.mean_s(); })
      .called("first after");
  real({"latency_max_s", "s", "longest of those times"},
       [](const Point&, const SenderTally& t) { return t.latency.worst_s(); });
  columns
      .real({"irradiance_mw_per_m2", "mW/m2", "highest irradiance along the way"},
            [](const Point& p, std::size_t i) { return p.senders[i].highest_irradiance; })
      .on({"device"})
      .called("highest irradiance");
}

// ---- frames heard ----

void add_heard(Columns<Point>& columns) {
  const auto real = [&](VariableFacts facts, double HeardFrame::*member) {
    columns
        .real(std::move(facts),
              [member](const Point& p, std::size_t i) { return p.heard[i].*member; })
        .on({"heard"});
  };
  columns
      .count({"heard_run", "1", "run"},
             [](const Point& p, std::size_t i) { return p.heard[i].run; })
      .on({"heard"});
  columns
      .words({"heard_device", "1", "index in device"},
             [](const Point& p, std::size_t i) { return p.senders[p.heard[i].sender].name; },
             {"device", "", "devices"})
      .on({"heard"});
  columns
      .words({"heard_message", "1", "index in message"},
             [](const Point& p, std::size_t i) { return p.heard[i].message; },
             {"message", "", "device messages that were delivered"})
      .on({"heard"});
  real({"heard_start_s", "s", "start of the message"}, &HeardFrame::start_s);
  real({"heard_end_s", "s", "end of the message"}, &HeardFrame::end_s);
  real({"heard_x_m", "m", "place of the receiver then"}, &HeardFrame::x_m);
  real({"heard_y_m", "m", "place of the receiver then"}, &HeardFrame::y_m);
}

}  // namespace

Columns<ArenaPoint> arena_variables() {
  Columns<Point> columns;
  columns.dimension({"device", "", "devices"}, device_labels);
  columns.list({"heard", "1", "frames delivered, by point, run and time"},
               [](const Point& p) { return p.heard.size(); });
  add_sums(columns);
  add_latency_and_load(columns);
  add_device_counts(columns);
  add_device_reals(columns);
  add_heard(columns);
  return columns;
}

const Columns<ArenaPoint>& arena_columns() {
  static const Columns<ArenaPoint> columns = [] {
    Columns<ArenaPoint> all = arena_variables();
    add_stop_reason(all);
    add_validity_flags(all);
    return all;
  }();
  return columns;
}

}  // namespace sim
