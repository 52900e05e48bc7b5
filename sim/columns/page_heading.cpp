#include "sim/columns/page_heading.hpp"

#include <algorithm>

#include "sim/text/unit_text.hpp"

namespace sim {
namespace {

/// "nothing known"; "throughput" of "through-" and "put"; the unit is left out.
std::string in_one_line(const TextColumn& heading) {
  std::string line;
  for (const std::string& part : heading.names) {
    if (part.empty() || (part.starts_with("[") && part.ends_with("]"))) continue;
    if (line.ends_with("-"))
      line.pop_back();
    else if (!line.empty())
      line += " ";
    line += part;
  }
  return line;
}

std::string_view without_prefix(std::string_view name, std::string_view prefix) {
  return name.starts_with(prefix) ? name.substr(prefix.size()) : name;
}

}  // namespace

std::string page_heading(const ColumnFacts& column) {
  std::string heading = column.page_heading;
  if (heading.empty()) heading = in_one_line(column.heading);
  if (heading.empty()) heading = name_in_words(column.facts.name);
  const std::string unit = bracketed_unit(column.facts.unit);
  return unit.empty() ? heading : heading + " " + unit;
}

std::string name_in_words(std::string_view name) {
  std::string words(without_prefix(name_of_each(name), "n_"));
  std::ranges::replace(words, '_', ' ');
  return words;
}

std::string_view name_of_each(std::string_view name) { return without_prefix(name, "total_"); }

}  // namespace sim
