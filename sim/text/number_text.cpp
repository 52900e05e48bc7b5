#include "sim/text/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "sim/failure.hpp"
#include "sim/text/list_text.hpp"

namespace sim {
namespace {

double number_of(std::string_view text, const std::string& problem) {
  const auto value = parse_number(text);
  if (!value) throw bad_input(problem, fmt::format("\"{}\" is not a number", text), how_to_write);
  if (!std::isfinite(*value)) throw bad_input(problem, "not a finite number", "write a finite one");
  return *value;
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

}  // namespace

void refuse_size(const std::string& problem) {
  throw bad_input(problem, fmt::format("more than {} points", most_points),
                  "use a larger step or fewer axes");
}

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

std::vector<double> stretched(std::vector<double> list, std::size_t size, const std::string& key,
                              const std::string& whole) {
  if (list.size() == 1) list.resize(size, list.front());
  if (list.size() != size)
    throw bad_input(fmt::format("{} has {} numbers", key, list.size()), whole,
                    fmt::format("give one or {}", size));
  return list;
}

}  // namespace sim
