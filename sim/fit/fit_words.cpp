#include "sim/fit/fit_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/columns/text_table.hpp"
#include "sim/fit/measured_part.hpp"
#include "sim/scenario/keys.hpp"
#include "sim/text/escaped_text.hpp"
#include "sim/text/rounded_text.hpp"
#include "sim/text/unit_text.hpp"

namespace sim {
namespace {

/// Digits behind the point that an interval supports: two of its half.
int places_of(const FittedNumber& number) {
  constexpr int most = 9;
  const double half = (number.high - number.low) / 2;
  if (!(half > 0)) return most;
  return std::clamp(1 - static_cast<int>(std::floor(std::log10(half))), 0, most);
}

std::string value_of(const FittedNumber& number) {
  return number.is_told ? fixed_text(number.value, places_of(number)) : "not told";
}

std::string interval_of(const FittedNumber& number) {
  if (!number.is_told) return "";
  const int places = places_of(number);
  return fmt::format("[{}, {}]", fixed_text(number.low, places, Rounding::down),
                     fixed_text(number.high, places, Rounding::up));
}

std::string value_of_like(const channel::ModuleData& like, const std::string& key) {
  for (const auto& number : module_keys().numbers)
    if (number.facts.name == key) return fmt::format("{}", like.*number.member);
  return "";
}

std::string level_sentence(const MeasuredModule& measured) {
  if (!measured.first_level_by.empty())
    return fmt::format(
        "Emin is for {:.4g} mW/m2 at the module in the plan's first step, as {} says, and is "
        "wrong by as much as that.",
        measured.fit.first_level_mw_per_m2, measured.first_level_by);
  return fmt::format(
      "Emin is that of {}, as the irradiance of the plan's first step is not known: measure it, "
      "and say --irradiance.",
      measured.like.name);
}

std::string clock_sentence(const FittedModule& fit) {
  const std::string begins =
      fmt::format("The plan begins at {:.4g} s of the recording", fit.start_s);
  const std::string percent = fixed_text(100 * std::abs(fit.clock_error), 3);
  if (std::stod(percent) == 0) return begins + ", and their clocks agree.";
  return fmt::format("{}, whose clock runs {} % too {}.", begins, percent,
                     fit.clock_error > 0 ? "fast" : "slow");
}

std::string more_sentence(const FittedNumber& number) {
  return fmt::format("{} is {}: what would tell it{} is {}.", number.key,
                     number.is_told ? "told, but not well" : "not told",
                     number.is_told ? " better" : "", number.more);
}

/// To the left, as wide as need be.
std::string lines_of_cells(const std::vector<std::vector<std::string>>& rows) {
  std::vector<TextColumn> columns(rows.front().size(), {{}, 0});
  for (const std::vector<std::string>& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i)
      columns[i].width = std::min(columns[i].width, -static_cast<int>(row[i].size()));
  std::string text;
  for (const std::vector<std::string>& row : rows) text += table_line(columns, row);
  return text;
}

}  // namespace

std::vector<std::string> fit_sentences(const MeasuredModule& measured) {
  const FittedModule& fit = measured.fit;
  std::vector<std::string> sentences{
      fmt::format("Read {} of {}, by {}: {} steps of light.", escaped_name(measured.wire),
                  escaped_name(measured.capture), measured.plan_words, measured.plan.steps.size()),
      clock_sentence(fit), level_sentence(measured)};
  for (const FittedNumber& number : fit.numbers)
    if (!number.more.empty()) sentences.push_back(more_sentence(number));
  for (const std::string& line : fit.not_apart)
    sentences.push_back("Not told apart: " + line + ".");
  for (const FitMisfit& misfit : fit.misfits)
    sentences.push_back("The part does not follow the rule: " + misfit_words(misfit) + ".");
  sentences.push_back(fmt::format("{}: {} deviations of {:.2f} standard deviations, as a rule.",
                                  fit.misfits.empty() ? "The part follows the rule" : "In all",
                                  fit.steps.size(), fit.usual_deviation));
  return sentences;
}

std::vector<std::string> constants_head(const MeasuredModule& measured) {
  return {"constant", "value", "95 % interval", "unit", measured.like.name};
}

std::vector<std::vector<std::string>> constants_rows(const MeasuredModule& measured) {
  std::vector<std::vector<std::string>> rows;
  for (const FittedNumber& number : measured.fit.numbers)
    rows.push_back({number.key, value_of(number), interval_of(number),
                    unit_text(unit_of_number(number.key)),
                    value_of_like(measured.like, number.key)});
  return rows;
}

bool tells_something(const MeasuredModule& measured) {
  return !number_names(measured.fit, true).empty();
}

std::string measured_text(const MeasuredModule& measured) {
  std::vector<std::vector<std::string>> rows = constants_rows(measured);
  rows.insert(rows.begin(), constants_head(measured));
  std::string text = lines_of_cells(rows);
  for (const std::string& sentence : fit_sentences(measured)) text += sentence + "\n";
  return text;
}

}  // namespace sim
