#include "sim/exchange/exchange_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "sim/counting/statistics.hpp"
#include "sim/report/estimate_text.hpp"
#include "sim/report/outside_report.hpp"
#include "sim/report/text_table.hpp"
#include "sim/text/rounded_text.hpp"

namespace sim {
namespace {

std::string seconds(double value) { return std::isnan(value) ? "-" : fmt::format("{:.2f}", value); }

std::string plain_ratio(double value) {
  if (std::isnan(value)) return "-";
  return value > 0 && value < 0.01 ? scientific_text(value, 2) : fmt::format("{:.3f}", value);
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
  const AgeCounts age = tally.age();
  const double unknown = age.unknown_share();
  return {fmt::format("{}", tally.n_sent),
          estimate_text(message_loss(tally)),
          plain_ratio(bit_error_ratio(tally)),
          seconds(age.mean_s()),
          seconds(age.quantile_s(high_share)),
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

std::string reason_texts(const SharedLinkReasons& reasons) {
  std::string text;
  for (std::size_t i = 1; i < reasons.size(); ++i)
    if (reasons[i] > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ",
                          protocol::name(static_cast<protocol::SharedLinkOutcome>(i)), reasons[i]);
  return text.empty() ? "none" : text;
}

}  // namespace

std::string exchange_header(const LoadedScenario& scenario) {
  return table_head(point_columns(scenario.sweep));
}

std::string exchange_row(const LoadedScenario& scenario, const ExchangePoint& point) {
  std::vector<std::string> texts = coordinate_texts(scenario.sweep, point.coordinates);
  texts.push_back(fmt::format("{:.4g}", point.irradiance_mw_per_m2));
  texts.push_back(fmt::format("{:.4g}", point.reflected_mw_per_m2));
  for (std::string& text : tally_texts(together(point.tally))) texts.push_back(std::move(text));
  texts.push_back(outside_mark(point.outside));
  return table_line(point_columns(scenario.sweep), texts);
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
  const DirectionTally all = together(point.tally);
  return table + "refused of the other: " + reason_texts(all.rejected) +
         "\nown messages damaged: " + reason_texts(all.own_damaged) + "\n";
}

}  // namespace sim
