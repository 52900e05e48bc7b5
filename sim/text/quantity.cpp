#include "sim/text/quantity.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

#include "sim/failure.hpp"
#include "sim/text/list_text.hpp"
#include "sim/text/unit_text.hpp"

namespace sim {
namespace {

/// A unit as so many powers of ten of another.
struct Multiple {
  std::string of;
  double times = 1;
  int tens = 0;
};

struct Spelling {
  const char* written;
  const char* unit;
  double times = 1;
  int tens = 0;
};

constexpr Spelling spellings[] = {
    {"W/m2", "W/m2"},   {"W/m^2", "W/m2"},   {"W/m²", "W/m2"},      {"lux", "lx"},
    {"deg", "degree"},  {"°", "degree"},     {"deg/s", "degree/s"}, {"°/s", "degree/s"},
    {"°C", "degree_C"}, {"C", "degree_C"},   {"ohm", "Ohm"},        {"Ω", "Ohm"},
    {"baud", "Bd"},     {"cycles", "cycle"}, {"sec", "s"},          {"min", "s", 60},
    {"h", "s", 3600},   {"%", "1", 1, -2},   {"ppm", "1", 1, -6},   {"1e-6", "1", 1, -6}};

struct Prefix {
  const char* written;
  int tens;
};

constexpr Prefix prefixes[] = {{"n", -9}, {"u", -6}, {"µ", -6}, {"m", -3},
                               {"c", -2}, {"k", 3},  {"M", 6},  {"G", 9}};

constexpr const char* with_prefixes[] = {"m",   "s",  "Hz",   "A",   "V",
                                         "Ohm", "Bd", "W/m2", "m/s", "A/W"};

Multiple spelt(const std::string& unit) {
  for (const Spelling& spelling : spellings)
    if (unit == spelling.written) return {spelling.unit, spelling.times, spelling.tens};
  return {unit};
}

Multiple multiple_of(const std::string& unit) {
  for (const Prefix& prefix : prefixes) {
    if (!unit.starts_with(prefix.written)) continue;
    const Multiple rest = spelt(unit.substr(std::string_view(prefix.written).size()));
    for (const char* base : with_prefixes)
      if (rest.of == base && rest.times == 1) return {rest.of, 1, prefix.tens};
  }
  return spelt(unit);
}

/// A number, and what stands behind it.
struct Quantity {
  std::optional<double> number;
  std::string unit;
};

Quantity quantity_of(std::string_view text) {
  text = trimmed(text);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || !std::isfinite(number)) return {};
  return {number, std::string(trimmed({end, text.data() + text.size()}))};
}

/// Divides by powers of ten, which are exact where their inverses are not: 7 cm are 0.07 m.
double times_tens(double number, int tens) {
  return tens < 0 ? number / std::pow(10, -tens) : number * std::pow(10, tens);
}

std::string converted(const Quantity& quantity, const std::string& unit,
                      const std::string& problem) {
  const Multiple from = multiple_of(quantity.unit), to = multiple_of(unit);
  if (from.of != to.of)
    throw bad_input(problem,
                    unit_text(unit).empty()
                        ? fmt::format("it has no unit, so none that is \"{}\"", quantity.unit)
                        : fmt::format("\"{}\" is no {}", quantity.unit, unit_text(unit)),
                    unit_text(unit).empty() ? "write the number alone"
                                            : "write the number in " + unit_text(unit));
  return fmt::format("{}",
                     times_tens(*quantity.number * from.times / to.times, from.tens - to.tens));
}

constexpr const char* separators = ":,";

std::vector<std::string_view> items_of(std::string_view text) {
  std::vector<std::string_view> items;
  for (std::size_t end = 0; end != std::string_view::npos; text.remove_prefix(end + 1)) {
    end = text.find_first_of(separators);
    items.push_back(text.substr(0, end));
    if (end == std::string_view::npos) break;
  }
  return items;
}

}  // namespace

bool has_unit(std::string_view text) {
  for (const std::string_view item : items_of(text)) {
    const Quantity quantity = quantity_of(item);
    if (quantity.number && !quantity.unit.empty()) return true;
  }
  return false;
}

std::string in_unit(std::string_view text, const std::string& unit, const std::string& problem) {
  if (!has_unit(text)) return std::string(text);
  const std::vector<std::string_view> items = items_of(text);
  std::vector<Quantity> quantities;
  bool others_have = false;
  for (const std::string_view& item : items) {
    quantities.push_back(quantity_of(item));
    if (!quantities.back().number)
      throw bad_input(problem, fmt::format("\"{}\" is not a number", trimmed(item)),
                      "write numbers, each with its unit");
    others_have |= &item != &items.back() && !quantities.back().unit.empty();
  }
  std::string numbers;
  for (std::size_t i = 0; i < items.size(); ++i) {
    Quantity& quantity = quantities[i];
    if (quantity.unit.empty() && !others_have) quantity.unit = quantities.back().unit;
    if (quantity.unit.empty())
      throw bad_input(problem, fmt::format("\"{}\" has no unit, others have", trimmed(items[i])),
                      "write a unit behind each number, or behind the last alone");
    numbers += converted(quantity, unit, problem);
    const auto behind = static_cast<std::size_t>(items[i].data() + items[i].size() - text.data());
    if (behind < text.size()) numbers += text[behind];
  }
  return numbers;
}

}  // namespace sim
