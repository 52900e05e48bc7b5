#include "sim/capture/capture_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <span>
#include <utility>

#include "sim/capture/sample_capture.hpp"
#include "sim/text/letters.hpp"
#include "sim/text/number_text.hpp"

namespace sim {
namespace {

using dsp::Hertz;
using dsp::Seconds;
using Spelling = std::pair<std::string_view, double>;

/// In lower case; "µ" and "μ" are two signs that look alike. Names of other languages are those
/// that PicoScope and spreadsheets write.
constexpr Spelling spelt_times[] = {{"s", 1},
                                    {"sec", 1},
                                    {"secs", 1},
                                    {"second", 1},
                                    {"seconds", 1},
                                    {"ms", 1e-3},
                                    {"msec", 1e-3},
                                    {"msecs", 1e-3},
                                    {"millisecond", 1e-3},
                                    {"milliseconds", 1e-3},
                                    {"us", 1e-6},
                                    {"usec", 1e-6},
                                    {"usecs", 1e-6},
                                    {"\u00b5s", 1e-6},
                                    {"\u03bcs", 1e-6},
                                    {"\u00b5sec", 1e-6},
                                    {"microsecond", 1e-6},
                                    {"microseconds", 1e-6},
                                    {"ns", 1e-9},
                                    {"nsec", 1e-9},
                                    {"nsecs", 1e-9},
                                    {"nanosecond", 1e-9},
                                    {"nanoseconds", 1e-9},
                                    {"millis", 1e-3},
                                    {"micros", 1e-6},
                                    {"nanos", 1e-9},
                                    {"sekunde", 1},
                                    {"sekunden", 1},
                                    {"millisekunden", 1e-3},
                                    {"mikrosekunden", 1e-6},
                                    {"nanosekunden", 1e-9},
                                    {"secondes", 1},
                                    {"millisecondes", 1e-3},
                                    {"microsecondes", 1e-6},
                                    {"\u79d2", 1},
                                    {"\u6beb\u79d2", 1e-3},
                                    {"\u5fae\u79d2", 1e-6},
                                    {"\u7eb3\u79d2", 1e-9},
                                    {"ps", 1e-12},
                                    {"psec", 1e-12},
                                    {"picosecond", 1e-12},
                                    {"picoseconds", 1e-12},
                                    {"min", 60},
                                    {"minute", 60},
                                    {"minutes", 60}};
/// As they are written: "mHz" would be a thousandth.
constexpr Spelling spelt_rates[] = {{"", 1},
                                    {"Hz", 1},
                                    {"hz", 1},
                                    {"k", 1e3},
                                    {"kHz", 1e3},
                                    {"KHz", 1e3},
                                    {"khz", 1e3},
                                    {"M", 1e6},
                                    {"MHz", 1e6},
                                    {"mhz", 1e6},
                                    {"G", 1e9},
                                    {"GHz", 1e9},
                                    {"Sa/s", 1},
                                    {"kSa/s", 1e3},
                                    {"MSa/s", 1e6},
                                    {"GSa/s", 1e9},
                                    {"S/s", 1},
                                    {"kS/s", 1e3},
                                    {"MS/s", 1e6},
                                    {"GS/s", 1e9},
                                    {"sps", 1},
                                    {"Sps", 1},
                                    {"ksps", 1e3},
                                    {"kSps", 1e3},
                                    {"Msps", 1e6},
                                    {"MSps", 1e6},
                                    {"Gsps", 1e9},
                                    {"GSps", 1e9},
                                    {"SPS", 1},
                                    {"kSPS", 1e3},
                                    {"KSPS", 1e3},
                                    {"MSPS", 1e6},
                                    {"GSPS", 1e9},
                                    {"S/sec", 1},
                                    {"kS/sec", 1e3},
                                    {"MS/sec", 1e6},
                                    {"samples/s", 1},
                                    {"ksamples/s", 1e3},
                                    {"Msamples/s", 1e6},
                                    {"samples/second", 1},
                                    {"samples per second", 1}};
constexpr std::string_view other_units[] = {"v", "volt", "volts", "mv",     "uv",  "\u00b5v",
                                            "a", "ma",   "value", "\u4f0f", "amp", "ampere",
                                            "w", "db",   "dbm",   "hz"};

std::string_view bare(std::string_view text) {
  constexpr std::string_view around = " \t\"";
  const std::size_t first = text.find_first_not_of(around);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(around) + 1 - first);
}

std::string_view without_brackets(std::string_view text) {
  text = bare(text);
  if (text.size() >= 2 &&
      ((text.front() == '(' && text.back() == ')') || (text.front() == '[' && text.back() == ']')))
    return bare(text.substr(1, text.size() - 2));
  return text;
}

std::optional<double> found_in(std::span<const Spelling> table, std::string_view word) {
  for (const auto& [written, factor] : table)
    if (written == word) return factor;
  return std::nullopt;
}

/// Where a number ends and its unit begins.
std::size_t end_of_number(std::string_view text) {
  std::size_t end = std::min(text.find_first_not_of("0123456789.+-"), text.size());
  const bool has_exponent = end + 1 < text.size() && (text[end] == 'e' || text[end] == 'E') &&
                            (std::isdigit(static_cast<unsigned char>(text[end + 1])) != 0 ||
                             text[end + 1] == '-' || text[end + 1] == '+');
  if (has_exponent) end = std::min(text.find_first_not_of("0123456789+-", end + 1), text.size());
  return end;
}

std::optional<double> parse_with(std::span<const Spelling> table, std::string_view text,
                                 double plain) {
  text = bare(text);
  const std::size_t end = end_of_number(text);
  const auto number = parse_number(text.substr(0, end));
  const std::string_view unit = bare(text.substr(end));
  const auto factor = unit.empty() ? std::optional(plain) : found_in(table, unit);
  if (!number || !factor || !std::isfinite(*number)) return std::nullopt;
  return *number * *factor;
}

/// With brackets and the micro sign as they are written elsewhere: those of Chinese are wider, and
/// Windows' own code has the sign as the one byte b5.
std::string usual_signs(std::string_view text) {
  std::string usual;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::string_view wide = text.substr(i, 3);
    if (wide == "\uff08" || wide == "\uff09") {
      usual += wide == "\uff08" ? '(' : ')';
      i += 2;
    } else if (text[i] == '\xb5' && (i == 0 || static_cast<signed char>(text[i - 1]) >= 0)) {
      usual += "\u00b5";
    } else {
      usual += text[i];
    }
  }
  return usual;
}

/// "time" and "Ms" of "timeMs".
std::optional<Heading> with_capital_unit(std::string_view text) {
  for (const std::string_view unit : {"Ms", "Us", "Ns"})
    if (text.ends_with(unit) && is_time_name(text.substr(0, text.size() - 2)))
      return Heading{std::string(text.substr(0, text.size() - 2)), std::string(unit)};
  return std::nullopt;
}

Heading split_at(std::string_view text, std::size_t at, std::string_view unit) {
  return {std::string(bare(text.substr(0, at))), std::string(bare(unit))};
}

Heading parts_of(std::string_view text) {
  const std::size_t open = text.find_last_of("([");
  if (open != std::string_view::npos && (text.back() == ')' || text.back() == ']'))
    return split_at(text, open, text.substr(open + 1, text.size() - open - 2));
  if (text.starts_with("in ")) return {"", std::string(bare(text.substr(3)))};
  if (const std::size_t in = text.rfind(" in "); in != std::string_view::npos)
    return split_at(text, in, text.substr(in + 4));
  if (const auto heading = with_capital_unit(text)) return *heading;
  while (text.ends_with('.')) text.remove_suffix(1);  // R has "time..ms."
  for (const char joint : {'/', '_', ',', ' ', '.', ':', '-'}) {
    const std::size_t at = text.rfind(joint);
    if (at != std::string_view::npos && time_unit(text.substr(at + 1)))
      return split_at(text, at, text.substr(at + 1));
  }
  if (in_lower_case(text).size() > 1 && time_unit(text)) return {"", std::string(text)};
  return {std::string(text), ""};
}

}  // namespace

std::optional<Seconds> time_unit(std::string_view word) {
  const auto factor = found_in(spelt_times, in_lower_case(usual_signs(without_brackets(word))));
  return factor ? std::optional(Seconds(*factor)) : std::nullopt;
}

bool is_unit_word(std::string_view field) {
  const std::string_view text = bare(field);
  if (text.empty()) return false;
  if (text.front() == '(' && text.back() == ')') return true;
  const std::string word = in_lower_case(without_brackets(text));
  return found_in(spelt_times, word).has_value() ||
         std::ranges::find(other_units, word) != std::end(other_units);
}

std::optional<Hertz> parse_sample_rate(std::string_view text) {
  const auto number = parse_with(spelt_rates, text, 1);
  if (!number || !is_sample_rate(Hertz(*number))) return std::nullopt;
  return Hertz(*number);
}

std::optional<Seconds> parse_interval(std::string_view text, Seconds unit) {
  const auto number = parse_with(spelt_times, in_lower_case(text), unit.value);
  return number ? std::optional(Seconds(*number)) : std::nullopt;
}

std::string samples_text(Hertz rate) { return fmt::format("{:.10g} samples a second", rate.value); }

std::string ticks_text(Seconds tick) {
  return tick.value == 1 ? "time in s" : fmt::format("time in steps of {:.6g} s", tick.value);
}

Heading heading_of(std::string_view field) {
  const std::string usual = usual_signs(bare(field));
  Heading heading = parts_of(usual);
  heading.text = bare(field);
  return heading;
}

bool is_time_name(std::string_view name) {
  constexpr std::string_view names[] = {
      "time",      "times",      "t",        "x",       "x-axis",       "x_value",
      "timestamp", "time stamp", "timebase", "elapsed", "elapsed time", "relative time",
      "time rel",  "zeit",       "temps",    "tiempo",  "tempo",        "\u65f6\u95f4"};
  const std::string low = in_lower_case(bare(name));
  const bool is_one_of_several =  // "Time CLK", but not "Timer"
      low.starts_with("time") && low.size() > 4 &&
      std::isalpha(static_cast<unsigned char>(low[4])) == 0;
  return is_one_of_several || std::ranges::find(names, low) != std::end(names);
}

bool is_of_time(const Heading& heading) {
  return is_time_name(heading.name) || time_unit(heading.unit);
}

bool names_time(std::span<const std::string> fields) {
  return std::ranges::any_of(
      fields, [](const std::string& field) { return is_of_time(heading_of(field)); });
}

}  // namespace sim
