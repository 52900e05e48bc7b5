#include "sim/fit/fit_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>

#include "sim/columns/text_table.hpp"
#include "sim/fit/fitted_steps.hpp"
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

std::string clock_sentence(const FittedCapture& fitted) {
  const std::string begins =
      fmt::format("The plan begins at {:.4g} s of the recording", fitted.start_s);
  const std::string percent = fixed_text(100 * std::abs(fitted.clock_error), 3);
  if (std::stod(percent) == 0) return begins + ", and their clocks agree.";
  return fmt::format("{}, whose clock runs {} % too {}.", begins, percent,
                     fitted.clock_error > 0 ? "fast" : "slow");
}

/// Of a capture behind the first one.
std::string light_sentence(const MeasuredCapture& capture, const FittedCapture& fitted,
                           const std::string& first) {
  const std::string by = fmt::format("{} dB {}", fixed_text(std::abs(fitted.level_db), 2),
                                     fitted.level_db < 0 ? "weaker" : "stronger");
  if (capture.ambient_w_per_m2 > 0)
    return fmt::format("Under the lamp of {:g} W/m2 its light seems {} than that of {}.",
                       capture.ambient_w_per_m2, by, first);
  return fmt::format("Its light is {} than that of {}{}.", by, first,
                     capture.is_of_known_level ? "" : ", as the recording says");
}

/// Of so many in the plan.
std::string steps_in_words(std::size_t steps, const FittedCapture& fitted) {
  if (fitted.fitted_steps == steps) return fmt::format("{} steps of light", steps);
  return fmt::format(
      "the first {} of {} steps of light{}", fitted.fitted_steps, steps,
      fitted.is_cut_short ? ", where the recording ends" : ", as the others tell nothing more");
}

std::vector<std::string> capture_sentences(const MeasuredModule& measured) {
  std::vector<std::string> sentences;
  const std::string first = escaped_name(measured.captures.front().file);
  for (std::size_t k = 0; k < measured.captures.size(); ++k) {
    const MeasuredCapture& capture = measured.captures[k];
    sentences.push_back(fmt::format("Read {} of {}, by {}: {}.", escaped_name(capture.wire),
                                    escaped_name(capture.file), capture.plan_words,
                                    steps_in_words(capture.steps, measured.fit.captures[k])));
    if (capture.lost_pairs > 0)
      sentences.push_back(
          fmt::format("The sketch left out {} pairs of edges of {}: something else lights the "
                      "module. Shade it, "
                      "and record again.",
                      capture.lost_pairs, escaped_name(capture.file)));
    if (capture.is_of_messages)
      sentences.emplace_back(
          "Of messages that the module did not report at all nothing is known, and messages tell "
          "little: show it a plan of light (cosys-sim fit --plan).");
    else
      sentences.push_back(clock_sentence(measured.fit.captures[k]));
    if (capture.is_of_drive)
      sentences.emplace_back(
          "No wire tells how strong light is, so all of it is taken to be as strong: where there "
          "is "
          "a plan, say --plan.");
    if (k > 0) sentences.push_back(light_sentence(capture, measured.fit.captures[k], first));
  }
  return sentences;
}

/// Light that is stronger than all that the module was shown, where it matters.
std::optional<std::string> strongest_sentence(const MeasuredModule& measured) {
  const auto range = std::ranges::find(measured.fit.numbers, "agc_range_db", &FittedNumber::key);
  const auto over_emin_db = measured.fit.strongest_over_emin_db;
  if (range == measured.fit.numbers.end() || range->is_told || !over_emin_db) return std::nullopt;
  std::string text = fmt::format("The strongest light was {:.0f} dB above Emin", *over_emin_db);
  if (measured.first_level_by.empty()) return text + ": of stronger light nothing is told.";
  constexpr double led_mw_per_sr = 72;  // TSAL6200 at 100 mA, typical (Vishay 81010)
  const double strongest =
      measured.first_level_mw_per_m2 * std::pow(10, measured.fit.strongest_db / 20);
  return fmt::format(
      "{}, {:.3g} mW/m2: of stronger light, which an LED of {:g} mW/sr gives nearer than {:.2g} m, "
      "nothing is told.",
      text, strongest, led_mw_per_sr, std::sqrt(led_mw_per_sr / strongest));
}

/// As data sheets give it: how far the width of an output pulse is from that of its burst.
std::optional<std::string> width_sentence(const FittedModule& fit) {
  if (!fit.output_width) return std::nullopt;
  const auto& [least, most] = *fit.output_width;
  return fmt::format(
      "The output of a short burst at rest lasts {:+.1f} to {:+.1f} cycles more than the burst.",
      least, most);
}

std::string more_sentence(const FittedNumber& number, const std::vector<std::string>& names) {
  return fmt::format(
      "{} {} {}: what would tell {}{} is {}.", list_in_words(names),
      names.size() == 1 ? "is" : "are", number.is_told ? "told, but not well" : "not told",
      names.size() == 1 ? "it" : "them", number.is_told ? " better" : "", number.more);
}

/// Which light would tell what is not told: a sentence for all numbers that the same one would.
std::vector<std::string> more_sentences(const FittedModule& fit) {
  std::vector<std::string> sentences;
  for (auto first = fit.numbers.begin(); first != fit.numbers.end(); ++first) {
    const auto is_alike = [&](const FittedNumber& other) {
      return other.is_told == first->is_told && other.more == first->more;
    };
    if (first->more.empty() || std::any_of(fit.numbers.begin(), first, is_alike)) continue;
    std::vector<std::string> names;
    for (auto number = first; number != fit.numbers.end(); ++number)
      if (is_alike(*number)) names.push_back(number->key);
    sentences.push_back(more_sentence(*first, names));
  }
  return sentences;
}

/// Where a train is just held, noise decides of a part that has hardly any margin. The rule of the
/// fit is without noise.
std::optional<std::string> noise_sentence(const FittedModule& fit) {
  constexpr double hardly_any_db = 0.5;
  const auto margin = std::ranges::find(fit.numbers, "agc_margin_db", &FittedNumber::key);
  if (fit.misfits.empty() || margin == fit.numbers.end() || margin->value > hardly_any_db)
    return std::nullopt;
  return fmt::format(
      "With a margin of {:.2g} dB, noise decides whether bursts at the limit are reported, which "
      "the "
      "rule does not have: that alone may look like this, too.",
      margin->value);
}

/// Where the part does not follow the rule, and what else looks like that.
std::vector<std::string> misfit_sentences(const FittedModule& fit) {
  if (fit.misfits.empty()) return {};
  std::vector<std::string> sentences{
      "The part does not follow the rule of the model, so do not rely on what run makes of it:"};
  for (const FitMisfit& misfit : fit.misfits)
    sentences.push_back("- " + misfit_words(misfit) + ".");
  sentences.emplace_back(
      "A plan that was not the one played, levels that are not what it says, and captures of "
      "different modules look like this, too.");
  if (const auto noise = noise_sentence(fit)) sentences.push_back(*noise);
  return sentences;
}

/// Numbers that are far off by themselves, which the root of the mean square does not show, by the
/// kind of light.
std::optional<std::string> far_sentence(const FittedModule& fit) {
  constexpr double far = 8;
  std::map<std::string, int> numbers;
  for (const FittedStep& step : fit.steps)
    if (std::abs(step.deviation) > far)
      ++numbers[step.quantity.substr(0, step.quantity.find(": "))];
  if (numbers.empty()) return std::nullopt;
  std::vector<std::string> words;
  for (const auto& [light, n] : numbers) words.push_back(fmt::format("{} of {}", n, light));
  return fmt::format(
      "More than {} standard deviations off are {}. A few are usual of light near Emin and of "
      "trains "
      "that are just held; --page shows which they are.",
      far, list_in_words(words));
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

std::string level_sentence(const MeasuredModule& measured) {
  if (!measured.first_level_by.empty())
    return fmt::format(
        "Emin is for {:.4g} mW/m2 at the module in the plan's first step, as {} "
        "says, and is wrong by as much as that{}.",
        measured.first_level_mw_per_m2, measured.first_level_by,
        measured.is_first_level_measured
            ? ""
            : ": a TSAL6200 gives 0.55 to 2.8 times what a typical one does");
  return fmt::format(
      "Emin is that of {}, as the irradiance of the plan's first step is not known: measure it, "
      "and say --irradiance.",
      measured.like.name);
}

std::vector<std::string> answer_sentences(const MeasuredModule& measured) {
  const FittedModule& fit = measured.fit;
  std::vector<std::string> sentences{fmt::format(
      "{} of {} constants are told.", number_names(fit, true).size(), fit.numbers.size())};
  const std::vector<std::string> misfits = misfit_sentences(fit);
  std::ranges::copy(misfits, std::back_inserter(sentences));
  const bool is_followed = misfits.empty() && tells_something(measured);
  sentences.push_back(fmt::format(
      "{} {} numbers of the recording differ from the fit by {:.2f} standard deviations on the "
      "whole; 0.2 to {} is usual.",
      is_followed ? "The part follows the rule of the model:" : "In all,", fit.steps.size(),
      fit.usual_deviation, most_usual_deviation));
  if (const auto far = far_sentence(fit)) sentences.push_back(*far);
  return sentences;
}

std::vector<std::string> further_sentences(const MeasuredModule& measured) {
  const FittedModule& fit = measured.fit;
  std::vector<std::string> sentences = capture_sentences(measured);
  sentences.push_back(level_sentence(measured));
  if (const auto width = width_sentence(fit)) sentences.push_back(*width);
  if (const auto strongest = strongest_sentence(measured)) sentences.push_back(*strongest);
  std::ranges::copy(more_sentences(fit), std::back_inserter(sentences));
  for (const std::string& line : fit.not_apart)
    sentences.push_back("Not told apart: " + line + ".");
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

std::string files_in_words(const std::vector<MeasuredCapture>& captures) {
  std::vector<std::string> files;
  for (const MeasuredCapture& capture : captures) files.push_back(capture.file);
  return list_in_words(files);
}

bool tells_something(const MeasuredModule& measured) {
  return !number_names(measured.fit, true).empty();
}

std::string measured_text(const MeasuredModule& measured) {
  std::vector<std::vector<std::string>> rows = constants_rows(measured);
  rows.insert(rows.begin(), constants_head(measured));
  std::string text = lines_of_cells(rows);
  for (const auto& sentences : {further_sentences(measured), answer_sentences(measured)})
    for (const std::string& sentence : sentences) text += sentence + "\n";
  return text;
}

}  // namespace sim
