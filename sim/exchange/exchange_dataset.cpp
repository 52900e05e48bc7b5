#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "sim/exchange/exchange_report.hpp"
#include "sim/report/outside_report.hpp"

namespace sim {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

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

struct CountColumn {
  VariableFacts facts;
  bool is_count;
  Read read;
};

std::vector<CountColumn> count_columns() {
  using T = DirectionTally;
  const auto count = [](const char* name, const char* what, std::uint64_t T::*member) {
    return CountColumn{
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
       [](const T& t) { return message_loss(t).value; }},
      {{"message_loss_ci_low", "1", "lower end of its interval"},
       false,
       [](const T& t) { return message_loss(t).low; }},
      {{"message_loss_ci_high", "1", "upper end of its interval"},
       false,
       [](const T& t) { return message_loss(t).high; }},
      {{"ber", "1", "bit error ratio"}, false, [](const T& t) { return bit_error_ratio(t); }},
      {{"age_mean_s", "s", "mean age of its values at the other node"},
       false,
       [](const T& t) { return t.age().mean_s(); }},
      {{"age_p95_s", "s", "age that 95 % of the time is not exceeded"},
       false,
       [](const T& t) { return t.age().quantile_s(high_share); }},
      {{"unknown_share", "1", "share of time in which nothing is known"},
       false,
       [](const T& t) { return t.age().unknown_share(); }},
  };
}

void add_reasons(Dataset& data, const std::vector<ExchangePoint>& points, VariableFacts facts,
                 SharedLinkReasons DirectionTally::*reasons) {
  std::vector<std::int64_t> values;
  for (const ExchangePoint& point : points)
    for (const DirectionTally& tally : point.tally.direction)
      for (std::size_t i = 1; i < (tally.*reasons).size(); ++i)
        values.push_back(static_cast<std::int64_t>((tally.*reasons)[i]));
  data.variables.push_back({std::move(facts), true, {"sender", "reason"}, std::move(values)});
}

void add_rejections(Dataset& data, const std::vector<ExchangePoint>& points) {
  std::vector<std::string> reasons;
  for (std::size_t i = 1; i < protocol::shared_link_outcomes; ++i)
    reasons.emplace_back(protocol::name(static_cast<protocol::SharedLinkOutcome>(i)));
  data.dimensions.push_back({{"reason", "", "why a message was refused"}, reasons});
  add_reasons(data, points, {"n_rejected", "1", "messages refused by the other node"},
              &DirectionTally::rejected);
  add_reasons(data, points, {"n_own_damaged", "1", "messages of its own that the sender refused"},
              &DirectionTally::own_damaged);
}

std::size_t most_variables(const std::vector<ExchangePoint>& points) {
  std::size_t most = 0;
  for (const ExchangePoint& point : points)
    for (const DirectionTally& tally : point.tally.direction)
      most = std::max(most, tally.variable_ages.size());
  return most;
}

/// NaN where a point has fewer variables than others.
void add_age_variable(Dataset& data, const std::vector<ExchangePoint>& points, VariableFacts facts,
                      double (*read)(const AgeCounts&)) {
  const std::size_t n = most_variables(points);
  std::vector<double> values;
  for (const ExchangePoint& point : points)
    for (const DirectionTally& tally : point.tally.direction) {
      for (const AgeCounts& age : tally.variable_ages) values.push_back(read(age));
      values.resize(values.size() + n - tally.variable_ages.size(), nothing);
    }
  data.variables.push_back({std::move(facts), true, {"sender", "variable"}, std::move(values)});
}

void add_ages(Dataset& data, const std::vector<ExchangePoint>& points) {
  std::vector<double> numbers;
  for (std::size_t i = 1; i <= most_variables(points); ++i)
    numbers.push_back(static_cast<double>(i));
  if (numbers.empty()) return;  // nothing was run
  data.dimensions.push_back({{"variable", "1", "place in the sender's list"}, numbers});
  add_age_variable(data, points, {"variable_age_mean_s", "s", "mean age at the other node"},
                   [](const AgeCounts& age) { return age.mean_s(); });
  add_age_variable(data, points,
                   {"variable_age_p95_s", "s", "age that 95 % of the time is not exceeded"},
                   [](const AgeCounts& age) { return age.quantile_s(high_share); });
  add_age_variable(data, points,
                   {"variable_unknown_share", "1", "share of time in which nothing is known"},
                   [](const AgeCounts& age) { return age.unknown_share(); });
}

template <class T>
void add_point_variable(Dataset& data, const std::vector<ExchangePoint>& points,
                        VariableFacts facts, double (*read)(const ExchangePoint&)) {
  std::vector<T> values;
  for (const ExchangePoint& point : points) values.push_back(static_cast<T>(read(point)));
  data.variables.push_back({std::move(facts), true, {}, std::move(values)});
}

}  // namespace

Dataset exchange_dataset(const LoadedScenario& scenario, const std::string& command,
                         const std::vector<ExchangePoint>& points) {
  Dataset data = dataset_of(scenario, command);
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
  for (const CountColumn& column : count_columns()) {
    if (column.is_count)
      data.variables.push_back(
          {column.facts, true, {"sender"}, by_direction<std::int64_t>(points, column.read)});
    else
      data.variables.push_back(
          {column.facts, true, {"sender"}, by_direction<double>(points, column.read)});
  }
  add_rejections(data, points);
  add_ages(data, points);
  return data;
}

}  // namespace sim
