#include "sim/scenario/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "sim/failure.hpp"
#include "sim/scenario/key_check.hpp"
#include "sim/text/number_text.hpp"

namespace sim {
namespace {

void refuse_equal_numbers(const Axis& axis, const std::string& place) {
  std::vector<double> sorted = axis.values;
  std::ranges::sort(sorted);
  const auto twin = std::ranges::adjacent_find(sorted);
  if (twin == sorted.end()) return;
  throw bad_input(fmt::format("{} = {} {}", axis.key, *twin, place), "twice in the same sweep",
                  "remove one of the two");
}

}  // namespace

Axis make_axis(const Key& key, std::vector<double> values, const std::string& place) {
  assert(key.is_number());
  if (values.empty()) throw bad_input(key.name() + " " + place, "an empty sweep", how_to_write);
  for (const double value : values) check_number(key.facts, value, place);
  Axis axis{key.name(), key.facts.unit, key.facts.long_name, std::move(values)};
  refuse_equal_numbers(axis, place);
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
