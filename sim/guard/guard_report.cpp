#include "sim/guard/guard_report.hpp"

#include <utility>

#include "sim/arena/arena_columns.hpp"
#include "sim/arena/arena_report.hpp"
#include "sim/columns/age_columns.hpp"
#include "sim/columns/columns_table.hpp"
#include "sim/columns/stop_column.hpp"
#include "sim/columns/validity_column.hpp"
#include "sim/loading/point_scenario.hpp"

namespace sim {
namespace {

using Point = GuardPoint;

/// Messages on their way, of one device or of all: in the table only.
template <class SentOf, class RelayedOf>
void add_way_of_messages(Columns<Point>& columns, const std::vector<std::string>& over,
                         SentOf sent_of, RelayedOf relayed_of) {
  columns.count({}, [=](const Point& p, std::size_t i) { return sent_of(p, i).messages(); })
      .on(over)
      .headed({{"", "", "messages"}, 9});
  columns
      .count({}, [=](const Point& p, std::size_t i) { return sent_of(p, i)[LossCause::delivered]; })
      .on(over)
      .headed({{"heard by", "the", "guard"}, 9});
  columns.count({}, [=](const Point& p, std::size_t i) { return relayed_of(p, i).n_known; })
      .on(over)
      .headed({{"known", "to the", "base"}, 9});
}

const RelayTally& relay_of(const Point& point, std::size_t device) {
  return point.relayed.relays[device];
}

void add_points(Columns<Point>& columns) {
  add_way_of_messages(
      columns, {}, [](const Point& p, std::size_t) { return together(p); },
      [](const Point& p, std::size_t) { return relayed_together(p); });
  add_age_columns(columns,
                  {.prefix = "total_",
                   .mean_is = "mean age of what the base station knows of all devices",
                   .where = "at base"},
                  [](const Point& p, std::size_t) { return relayed_together(p).age; });
}

void add_devices(Columns<Point>& columns) {
  columns.words({}, [](const Point& p, std::size_t i) { return p.senders[i].name; })
      .on({"device"})
      .headed({{"", "", "device"}, -6});
  columns.words({}, [](const Point& p, std::size_t i) { return p.variables[i]; })
      .on({"device"})
      .headed({{"", "", "variable"}, -8});
  add_way_of_messages(
      columns, {"device"},
      [](const Point& p, std::size_t i) -> const SenderTally& { return p.tally.senders[i]; },
      relay_of);
  const auto count = [&](VariableFacts facts, std::uint64_t RelayTally::*member) -> Column<Point>& {
    return columns
        .count(std::move(facts),
               [=](const Point& p, std::size_t i) { return relay_of(p, i).*member; })
        .on({"device"});
  };
  count({"n_replaced", "1", "messages replaced before they were passed on"},
        &RelayTally::n_replaced)
      .called("replaced by a newer one");
  count({"n_sharedlink_lost", "1", "messages lost between guard and base"}, &RelayTally::n_lost)
      .called("lost by SharedLink");
  count({"n_known", "1", "messages that the base station got to know"}, &RelayTally::n_known)
      .called("known to the base");
  add_age_columns(
      columns,
      {.prefix = "",
       .mean_is = "mean age of what the base station knows",
       .where = "at base",
       .over = {"device"},
       .drawn = DrawnColumn{"Age of what the base station knows", "mean age [s]"}},
      [](const Point& p, std::size_t i) -> const AgeCounts& { return relay_of(p, i).age; });
}

void add_line(Columns<Point>& columns) {
  const auto count = [&](VariableFacts facts, std::uint64_t GuardTally::*member) -> Column<Point>& {
    return columns.count(std::move(facts), [=](const Point& p) { return p.relayed.*member; });
  };
  count({"n_shared_messages_sent", "1", "SharedLink messages sent by guard and base"},
        &GuardTally::n_sent)
      .called("sent by SharedLink");
  count({"n_shared_messages_accepted", "1", "of those, accepted"}, &GuardTally::n_accepted)
      .called("accepted by SharedLink");
  count({"n_queries", "1", "questions that the base station asked"}, &GuardTally::n_asked)
      .headed({{"questions", "", "asked"}, 9});
  count({"n_queries_answered", "1", "of those, answered"}, &GuardTally::n_answered)
      .headed({{"", "", "answered"}, 9});
  count({"n_queries_timed_out", "1", "of those, without an answer in time"},
        &GuardTally::n_timed_out)
      .headed({{"", "timed", "out"}, 9});
}

Columns<Point> made_columns() {
  Columns<Point> columns;
  columns.add_stored(arena_variables());
  columns.stored("n_delivered").called("heard by the guard");
  add_points(columns);
  add_devices(columns);
  add_line(columns);
  add_stop_reason(columns);
  add_validity_flags(columns);
  return columns;
}

std::string details(const LoadedScenario& scenario, const Point& point) {
  return element_table(guard_columns(), "device", point) + "\n" + guard_waterfall(point) + "\n" +
         way_table(point_scenario(scenario, point.coordinates), point);
}

}  // namespace

const Columns<GuardPoint>& guard_columns() {
  static const Columns<GuardPoint> columns = made_columns();
  return columns;
}

std::string guard_waterfall(const GuardPoint& point) {
  const SenderTally sent = together(point);
  const RelayTally relay = relayed_together(point);
  std::vector<LossStage> stages = loss_stages(sent);
  stages.push_back({"replaced by a newer one", relay.n_replaced});
  stages.push_back({"SharedLink", relay.n_lost});
  return waterfall(sent.messages(), stages, "known to the base station");
}

constinit const PointReport<GuardPoint> guard_report{guard_columns, details};

}  // namespace sim
