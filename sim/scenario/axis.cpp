#include "sim/scenario/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "sim/failure.hpp"

namespace sim {

std::string coordinate_text(const Axis& axis, double coordinate) {
  return axis.is_text() ? axis.labels.at(static_cast<std::size_t>(coordinate))
                        : fmt::format("{:.6g}", coordinate);
}

std::string dimension_name(const std::string& key) {
  std::string name = key;
  std::ranges::replace(name, '.', '_');
  return name;
}

void check_dimension_names(const std::vector<Axis>& axes) {
  std::map<std::string, std::string> keys;
  for (const Axis& axis : axes) {
    const auto [old, is_new] = keys.try_emplace(dimension_name(axis.key), axis.key);
    if (!is_new)
      throw bad_input(old->second + " and " + axis.key, "the result file calls both " + old->first,
                      "rename one disturbance");
  }
}

}  // namespace sim
