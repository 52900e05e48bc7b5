#include "sim/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>

#include "sim/failure.hpp"
#include "sim/key_check.hpp"
#include "sim/list_text.hpp"

namespace sim {
namespace {

constexpr const char* how_to_write = "write a:step:b, such as 1:0.5:20, or a list, such as 1,2,5";

double number_of(std::string_view text, const std::string& problem) {
  const auto value = parse_number(text);
  if (!value) throw bad_input(problem, fmt::format("\"{}\" is not a number", text), how_to_write);
  if (!std::isfinite(*value)) throw bad_input(problem, "not a finite number", how_to_write);
  return *value;
}

[[noreturn]] void refuse_size(const std::string& problem) {
  throw bad_input(problem, fmt::format("more than {} points", most_points),
                  "use a larger step or fewer axes");
}

struct Steps {
  double first, step, last;
};

std::size_t count_steps(const Steps& s, const std::string& problem) {
  if (s.step == 0) throw bad_input(problem, "the step is zero", how_to_write);
  const double span = (s.last - s.first) / s.step;
  if (span < 0)
    throw bad_input(problem, "the step leads away from the end", "change the sign of the step");
  // A span that misses a whole number by less than this misses it by rounding.
  constexpr double rounding = 1e-9;
  const double steps = std::floor(span + rounding * std::max(1.0, span));
  if (!(steps < static_cast<double>(most_points))) refuse_size(problem);
  return static_cast<std::size_t>(steps) + 1;
}

/// The nearest number of few decimals, where `value` differs from it by rounding only: 14 digits of
/// the range's largest number.
double without_rounding(double value, double largest) {
  const int decimals = 14 - static_cast<int>(std::ceil(std::log10(largest)));
  if (decimals < 0 || decimals > 300) return value;
  return parse_number(fmt::format("{:.{}f}", value, decimals)).value() + 0.0;
}

std::vector<double> parse_range(std::string_view text, const std::string& problem) {
  const auto parts = split(text, ':');
  if (parts.size() != 3) throw bad_input(problem, "a range has three numbers", how_to_write);
  const Steps s{number_of(parts[0], problem), number_of(parts[1], problem),
                number_of(parts[2], problem)};
  std::vector<double> values(count_steps(s, problem));
  const double largest = std::max({std::abs(s.first), std::abs(s.step), std::abs(s.last)});
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = without_rounding(s.first + static_cast<double>(i) * s.step, largest);
  values.front() = s.first;
  return values;
}

void refuse_repetition(const Axis& axis, const std::string& place) {
  std::vector<double> sorted = axis.values;
  std::ranges::sort(sorted);
  const auto twin = std::ranges::adjacent_find(sorted);
  if (twin == sorted.end()) return;
  throw bad_input(fmt::format("{} = {} {}", axis.key, *twin, place), "twice in the same sweep",
                  "remove one of the two");
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
  text = trimmed(text);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

bool is_range_or_list(std::string_view text) {
  return text.find_first_of(":,") != std::string_view::npos;
}

std::vector<double> parse_values(std::string_view text, const std::string& problem) {
  if (trimmed(text).empty()) throw bad_input(problem, "no value", how_to_write);
  if (text.find(':') != std::string_view::npos) return parse_range(text, problem);
  std::vector<double> values;
  for (const auto part : split(text, ',')) values.push_back(number_of(part, problem));
  return values;
}

Axis make_axis(const Key& key, std::vector<double> values, const std::string& place) {
  assert(key.is_number());
  if (values.empty()) throw bad_input(key.name() + " " + place, "an empty sweep", how_to_write);
  for (const double value : values) check_number(key.facts, value, place);
  Axis axis{key.name(), key.facts.unit, key.facts.long_name, std::move(values)};
  refuse_repetition(axis, place);
  return axis;
}

std::size_t count_points(const std::vector<Axis>& axes) {
  std::size_t count = 1;
  for (const Axis& axis : axes) {
    if (axis.values.size() > most_points / count) refuse_size("the sweep up to " + axis.key);
    count *= axis.values.size();
  }
  return count;
}

std::vector<double> point_coordinates(const std::vector<Axis>& axes, std::size_t index) {
  std::vector<double> coordinates(axes.size());
  for (std::size_t i = axes.size(); i-- > 0;) {
    coordinates[i] = axes[i].values[index % axes[i].values.size()];
    index /= axes[i].values.size();
  }
  assert(index == 0);
  return coordinates;
}

}  // namespace sim
