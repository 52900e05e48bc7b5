#include "sim/shared_link/shared_link_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "sim/columns/age_columns.hpp"
#include "sim/columns/columns_table.hpp"
#include "sim/columns/stop_column.hpp"
#include "sim/columns/validity_column.hpp"
#include "sim/text/rounded_text.hpp"

namespace sim {
namespace {

using Point = SharedLinkPoint;

std::string ratio_text(double value) {
  if (std::isnan(value)) return "-";
  return value > 0 && value < 0.01 ? scientific_text(value, 2) : fmt::format("{:.3f}", value);
}

/// The columns of one direction, which are stored, or of both together in the table of points.
template <class TallyOf>
class DirectionColumns {
 public:
  DirectionColumns(Columns<Point>& columns, std::vector<std::string> over, TallyOf tally_of)
      : columns_(columns), over_(std::move(over)), tally_of_(std::move(tally_of)) {}

  void add_messages() {
    count("n_messages", "messages sent", &DirectionTally::n_sent, {{"", "messages", "sent"}, 8});
    count("n_accepted", "messages accepted by the other node", &DirectionTally::n_accepted);
    count("n_bits", "line bits sent", &DirectionTally::n_bits);
    count("n_bit_errors", "of those, wrong at the other's module", &DirectionTally::n_bit_errors);
    columns_
        .ratio(stored({"message_loss", "1", "messages not accepted over messages sent"}),
               [of = tally_of_](const Point& p, std::size_t i) { return message_loss(of(p, i)); })
        .on(over_)
        .headed({{"", "message loss ratio", "[interval]"}, -estimate_width})
        .drawn({"Message loss", "message loss ratio", true});
    columns_
        .real(
            stored({"ber", "1", "bit error ratio"}),
            [of = tally_of_](const Point& p, std::size_t i) { return bit_error_ratio(of(p, i)); },
            ratio_text)
        .on(over_)
        .headed({{"", "", "BER"}, 8});
  }

  void add_ages() {
    add_age_columns(columns_,
                    {.prefix = "",
                     .mean_is = "mean age of its values at the other node",
                     .where = "of values",
                     .over = over_,
                     .are_stored = !over_.empty(),
                     .drawn = DrawnColumn{"Age of values at the other node", "mean age [s]"}},
                    [of = tally_of_](const Point& p, std::size_t i) { return of(p, i).age(); });
  }

  void add_questions() {
    count("n_queries", "questions asked", &DirectionTally::n_asked,
          {{"questions", "", "asked"}, 9});
    count("n_queries_answered", "questions answered", &DirectionTally::n_answered,
          {{"", "", "answered"}, 9});
    count("n_queries_timed_out", "questions without an answer in time",
          &DirectionTally::n_timed_out, {{"", "timed", "out"}, 6});
    count("n_own_messages", "messages of its own that the sender heard", &DirectionTally::n_own,
          {{"own", "messages", "heard"}, 8});
  }

 private:
  VariableFacts stored(VariableFacts facts) const {
    return over_.empty() ? VariableFacts{} : std::move(facts);
  }

  void count(const char* name, const char* what, std::uint64_t DirectionTally::*member,
             const TextColumn& heading = {{}, 0}) {
    columns_
        .count(stored({name, "1", what}),
               [of = tally_of_, member](const Point& p, std::size_t i) { return of(p, i).*member; })
        .on(over_)
        .headed(heading);
  }

  Columns<Point>& columns_;
  std::vector<std::string> over_;
  TallyOf tally_of_;
};

template <class TallyOf>
void add_direction(Columns<Point>& columns, std::vector<std::string> over, TallyOf tally_of) {
  DirectionColumns to(columns, std::move(over), std::move(tally_of));
  to.add_messages();
  to.add_ages();
  to.add_questions();
}

/// Why messages were refused: of SharedLinkOutcome all but that they were not.
constexpr std::size_t all_reasons = protocol::shared_link_outcomes - 1;

std::string reason_name(std::size_t reason) {
  return std::string(protocol::name(static_cast<protocol::SharedLinkOutcome>(reason + 1)));
}

void add_refusals(Columns<Point>& columns) {
  const auto add = [&](VariableFacts facts, SharedLinkReasons DirectionTally::*member) {
    columns
        .count(std::move(facts),
               [=](const Point& p, std::size_t i) {
                 return (p.tally.direction[i / all_reasons].*member)[i % all_reasons + 1];
               })
        .on({"sender", "reason"});
  };
  add({"n_rejected", "1", "messages refused by the other node"}, &DirectionTally::rejected);
  add({"n_own_damaged", "1", "messages of its own that the sender refused"},
      &DirectionTally::own_damaged);
}

std::size_t most_variables(const Point& point) {
  std::size_t most = 0;
  for (const DirectionTally& tally : point.tally.direction)
    most = std::max(most, tally.variable_ages.size());
  return most;
}

/// NaN where a node has fewer variables than the other.
void add_variable_ages(Columns<Point>& columns) {
  add_age_columns(columns,
                  {.prefix = "variable_",
                   .mean_is = "mean age at the other node",
                   .over = {"sender", "variable"}},
                  [](const Point& p, std::size_t i) -> const AgeCounts& {
                    static const AgeCounts none;
                    const std::size_t all = most_variables(p), variable = i % all;
                    const auto& ages = p.tally.direction[i / all].variable_ages;
                    return variable < ages.size() ? ages[variable] : none;
                  });
}

void add_dimensions(Columns<Point>& columns) {
  columns.dimension({"sender", "", "node that sends"}, [](const Point&) {
    return std::vector<Label>{"A", "B"};
  });
  columns.dimension({"reason", "", "why a message was refused"}, [](const Point&) {
    std::vector<Label> names;
    for (std::size_t i = 0; i < all_reasons; ++i) names.emplace_back(reason_name(i));
    return names;
  });
  columns.dimension({"variable", "1", "place in the sender's list"}, [](const Point& p) {
    std::vector<Label> numbers;
    for (std::size_t i = 1; i <= most_variables(p); ++i)
      numbers.emplace_back(static_cast<double>(i));
    return numbers;
  });
}

Columns<Point> made_columns() {
  Columns<Point> columns;
  add_dimensions(columns);
  columns.count({"n_runs", "1", "runs"}, [](const Point& p) { return p.tally.n_runs; });
  columns
      .real({"irradiance_mw_per_m2", "mW/m2", "light of the other node"},
            [](const Point& p) { return p.irradiance_mw_per_m2; })
      .headed({{"", "irradiance", "[mW/m2]"}, number_width});
  columns
      .real({"reflected_mw_per_m2", "mW/m2", "light of the node's own LED"},
            [](const Point& p) { return p.reflected_mw_per_m2; })
      .headed({{"own", "reflection", "[mW/m2]"}, number_width});
  add_direction(columns, {}, [](const Point& p, std::size_t) { return together(p.tally); });
  add_stop_reason(columns);
  add_validity_flags(columns);
  columns.words({}, [](const Point&, std::size_t i) { return i == 0 ? "A to B" : "B to A"; })
      .on({"sender"})
      .headed({{"", "", "direction"}, -9});
  add_direction(columns, {"sender"}, [](const Point& p, std::size_t i) -> const DirectionTally& {
    return p.tally.direction[i];
  });
  add_refusals(columns);
  add_variable_ages(columns);
  return columns;
}

std::string refusal_text(const SharedLinkReasons& counts) {
  std::string text;
  for (std::size_t i = 0; i < all_reasons; ++i)
    if (counts[i + 1] > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", reason_name(i), counts[i + 1]);
  return text.empty() ? "none" : text;
}

/// Each direction, and why messages were refused.
std::string details(const LoadedScenario&, const Point& point) {
  const DirectionTally all = together(point.tally);
  return element_table(shared_link_columns(), "sender", point) +
         "refused of the other: " + refusal_text(all.rejected) +
         "\nown messages damaged: " + refusal_text(all.own_damaged) + "\n";
}

}  // namespace

const Columns<SharedLinkPoint>& shared_link_columns() {
  static const Columns<SharedLinkPoint> columns = made_columns();
  return columns;
}

constinit const PointReport<SharedLinkPoint> shared_link_report{shared_link_columns, details};

}  // namespace sim
