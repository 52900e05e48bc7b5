#include "sim/exchange/exchange_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "channel/instruction_set.hpp"
#include "sim/estimate_text.hpp"
#include "sim/outside_report.hpp"
#include "sim/point_scenario.hpp"
#include "sim/run_sharing.hpp"
#include "sim/statistics.hpp"
#include "sim/sweep.hpp"
#include "sim/text_table.hpp"

namespace sim {
namespace {

constexpr double ci_level = 0.95;
constexpr double high_share = 0.95;

ExchangePoint run_point(const Scenario& scenario, const std::vector<double>& coordinates,
                        const ExchangeOptions& options) {
  const Exchange exchange = make_exchange(scenario);
  ExchangePoint point{coordinates, exchange.irradiance_mw_per_m2, exchange.reflected_mw_per_m2,
                      exchange.outside};
  const auto runs = static_cast<std::uint32_t>(scenario.exchange.runs);
  RunSharing<ExchangeTally> sharing(
      {.runs = runs,
       .most_at_once = static_cast<std::uint32_t>(channel::trials_at_once()),
       .threads = options.threads,
       .stop = options.interrupt},
      [&](std::uint32_t first, int n) {
        return run_exchange(exchange, first, n, options.interrupt);
      });
  for (const ExchangeTally& lot : sharing()) point.tally += lot;
  return point;
}

Estimate loss_ratio(const DirectionTally& tally) {
  if (tally.n_sent == 0) return {unset, unset, unset};
  const auto sent = static_cast<double>(tally.n_sent);
  const double lost = sent - static_cast<double>(tally.n_accepted);
  const Interval interval = clopper_pearson(lost, sent, ci_level);
  return {lost / sent, interval.low, interval.high};
}

double bit_error_ratio_of(const DirectionTally& tally) {
  return ratio(tally.n_bit_errors, tally.n_bits);
}

// ---- tables ----

std::string seconds(double value) { return std::isnan(value) ? "-" : fmt::format("{:.2f}", value); }

std::string plain_ratio(double value) {
  if (std::isnan(value)) return "-";
  return value > 0 && value < 0.01 ? scientific(value, 2) : fmt::format("{:.3f}", value);
}

std::vector<TextColumn> tally_columns() {
  return {{{"", "messages", "sent"}, 8},
          {{"", "message loss ratio", "[interval]"}, -estimate_width},
          {{"", "", "BER"}, 8},
          {{"mean age", "of values", "[s]"}, 9},
          {{"95 % of", "ages", "[s]"}, 8},
          {{"nothing", "known", ""}, 8},
          {{"questions", "", "asked"}, 9},
          {{"", "", "answered"}, 9},
          {{"", "timed", "out"}, 6},
          {{"own", "messages", "heard"}, 8}};
}

std::vector<std::string> tally_texts(const DirectionTally& tally) {
  const double unknown = tally.age.unknown_share();
  return {fmt::format("{}", tally.n_sent),
          estimate_text(loss_ratio(tally)),
          plain_ratio(bit_error_ratio_of(tally)),
          seconds(tally.age.mean_s()),
          seconds(tally.age.quantile_s(high_share)),
          std::isnan(unknown) ? "-" : fmt::format("{:.1f} %", 100 * unknown),
          fmt::format("{}", tally.n_asked),
          fmt::format("{}", tally.n_answered),
          fmt::format("{}", tally.n_timed_out),
          fmt::format("{}", tally.n_own)};
}

std::vector<TextColumn> point_columns(const std::vector<Axis>& axes) {
  std::vector<TextColumn> columns = axis_columns(axes);
  columns.push_back({{"", "irradiance", "[mW/m2]"}, number_width});
  columns.push_back({{"own", "reflection", "[mW/m2]"}, number_width});
  for (const TextColumn& column : tally_columns()) columns.push_back(column);
  columns.push_back(outside_column());
  return columns;
}

std::string rejections(const DirectionTally& tally) {
  std::string text;
  for (std::size_t i = 1; i < tally.rejected.size(); ++i)
    if (tally.rejected[i] > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ",
                          protocol::name(static_cast<protocol::SharedLinkOutcome>(i)),
                          tally.rejected[i]);
  return text.empty() ? "none" : text;
}

// ---- dataset ----

using Read = std::function<double(const DirectionTally&)>;

/// One value a point and direction.
template <class T>
std::vector<T> by_direction(const std::vector<ExchangePoint>& points, const Read& read) {
  std::vector<T> values;
  for (const ExchangePoint& point : points)
    for (const DirectionTally& tally : point.tally.direction)
      values.push_back(static_cast<T>(read(tally)));
  return values;
}

struct Column {
  VariableFacts facts;
  bool is_count;
  Read read;
};

std::vector<Column> columns() {
  using T = DirectionTally;
  const auto count = [](const char* name, const char* what, std::uint64_t T::*member) {
    return Column{
        {name, "1", what}, true, [=](const T& t) { return static_cast<double>(t.*member); }};
  };
  return {
      count("n_messages", "messages sent", &T::n_sent),
      count("n_accepted", "messages accepted by the other node", &T::n_accepted),
      count("n_bits", "line bits sent", &T::n_bits),
      count("n_bit_errors", "of those, wrong at the other's module", &T::n_bit_errors),
      count("n_queries", "questions asked", &T::n_asked),
      count("n_queries_answered", "questions answered", &T::n_answered),
      count("n_queries_timed_out", "questions without an answer in time", &T::n_timed_out),
      count("n_own_messages", "messages of its own that the sender heard", &T::n_own),
      {{"message_loss", "1", "messages not accepted over messages sent"},
       false,
       [](const T& t) { return loss_ratio(t).value; }},
      {{"message_loss_ci_low", "1", "lower end of its interval"},
       false,
       [](const T& t) { return loss_ratio(t).low; }},
      {{"message_loss_ci_high", "1", "upper end of its interval"},
       false,
       [](const T& t) { return loss_ratio(t).high; }},
      {{"ber", "1", "bit error ratio"}, false, bit_error_ratio_of},
      {{"age_mean_s", "s", "mean age of its values at the other node"},
       false,
       [](const T& t) { return t.age.mean_s(); }},
      {{"age_p95_s", "s", "age that 95 % of the time is not exceeded"},
       false,
       [](const T& t) { return t.age.quantile_s(high_share); }},
      {{"unknown_share", "1", "share of time in which nothing is known"},
       false,
       [](const T& t) { return t.age.unknown_share(); }},
  };
}

void add_rejections(Dataset& data, const std::vector<ExchangePoint>& points) {
  std::vector<std::string> reasons;
  for (std::size_t i = 1; i < protocol::shared_link_outcomes; ++i)
    reasons.emplace_back(protocol::name(static_cast<protocol::SharedLinkOutcome>(i)));
  data.dimensions.push_back({{"reason", "", "why a message was refused"}, reasons});
  std::vector<std::int64_t> values;
  for (const ExchangePoint& point : points)
    for (const DirectionTally& tally : point.tally.direction)
      for (std::size_t i = 1; i < tally.rejected.size(); ++i)
        values.push_back(static_cast<std::int64_t>(tally.rejected[i]));
  data.variables.push_back({{"n_rejected", "1", "messages refused by the other node"},
                            true,
                            {"sender", "reason"},
                            std::move(values)});
}

template <class T>
void add_point_variable(Dataset& data, const std::vector<ExchangePoint>& points,
                        VariableFacts facts, double (*read)(const ExchangePoint&)) {
  std::vector<T> values;
  for (const ExchangePoint& point : points) values.push_back(static_cast<T>(read(point)));
  data.variables.push_back({std::move(facts), true, {}, std::move(values)});
}

}  // namespace

DirectionTally together(const ExchangeTally& tally) {
  DirectionTally sum = tally.direction[0];
  return sum += tally.direction[1];
}

std::vector<ExchangePoint> run_exchanges(const LoadedScenario& scenario,
                                         const ExchangeOptions& options) {
  std::vector<ExchangePoint> points(count_points(scenario.sweep));
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].coordinates = point_coordinates(scenario.sweep, i);
    if (options.interrupt != nullptr && *options.interrupt) continue;
    points[i] =
        run_point(point_scenario(scenario, points[i].coordinates), points[i].coordinates, options);
    if (options.on_point && points[i].tally.n_runs > 0) options.on_point(points[i]);
  }
  return points;
}

std::string exchange_header(const std::vector<Axis>& axes) {
  return table_head(point_columns(axes));
}

std::string exchange_row(const std::vector<Axis>& axes, const ExchangePoint& point) {
  std::vector<std::string> texts = coordinate_texts(axes, point.coordinates);
  texts.push_back(fmt::format("{:.4g}", point.irradiance_mw_per_m2));
  texts.push_back(fmt::format("{:.4g}", point.reflected_mw_per_m2));
  for (std::string& text : tally_texts(together(point.tally))) texts.push_back(std::move(text));
  texts.push_back(outside_mark(point.outside));
  return table_line(point_columns(axes), texts);
}

std::string direction_table(const ExchangePoint& point) {
  std::vector<TextColumn> columns{{{"", "", "direction"}, -9}};
  for (const TextColumn& column : tally_columns()) columns.push_back(column);
  std::string table = table_head(columns);
  for (std::size_t i = 0; i < 2; ++i) {
    std::vector<std::string> texts{i == 0 ? "A to B" : "B to A"};
    for (std::string& text : tally_texts(point.tally.direction[i]))
      texts.push_back(std::move(text));
    table += table_line(columns, texts);
  }
  return table + "refused: " + rejections(together(point.tally)) + "\n";
}

Dataset exchange_dataset(const LoadedScenario& scenario, const std::string& command,
                         const std::vector<ExchangePoint>& points) {
  Dataset data{.title = scenario.base.title,
               .scenario_toml = scenario.text,
               .command = command,
               .experiment = "sharedlink",
               .seed = static_cast<std::uint64_t>(scenario.base.simulation.seed),
               .axes = scenario.sweep};
  for (const ExchangePoint& point : points) data.n_runs += point.tally.n_runs;
  data.dimensions.push_back(
      {{"sender", "", "node that sends"}, std::vector<std::string>{"A", "B"}});
  add_point_variable<std::int64_t>(
      data, points, {"n_runs", "1", "runs"},
      [](const ExchangePoint& p) { return static_cast<double>(p.tally.n_runs); });
  add_point_variable<double>(data, points,
                             {"irradiance_mw_per_m2", "mW/m2", "light of the other node"},
                             [](const ExchangePoint& p) { return p.irradiance_mw_per_m2; });
  add_point_variable<double>(data, points,
                             {"reflected_mw_per_m2", "mW/m2", "light of the node's own LED"},
                             [](const ExchangePoint& p) { return p.reflected_mw_per_m2; });
  std::vector<std::int64_t> outside;
  for (const ExchangePoint& p : points) outside.push_back(static_cast<std::int64_t>(p.outside));
  data.variables.push_back(outside_variable(std::move(outside)));
  for (const Column& column : columns()) {
    if (column.is_count)
      data.variables.push_back(
          {column.facts, true, {"sender"}, by_direction<std::int64_t>(points, column.read)});
    else
      data.variables.push_back(
          {column.facts, true, {"sender"}, by_direction<double>(points, column.read)});
  }
  add_rejections(data, points);
  return data;
}

}  // namespace sim
