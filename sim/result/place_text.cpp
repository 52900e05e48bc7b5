#include "sim/result/place_text.hpp"

#include <fmt/ranges.h>

#include "sim/text/unit_text.hpp"

namespace sim {

std::string quantity(const Axis& axis, const std::string& value) {
  return axis.key + " = " + with_unit(value, axis.unit);
}

std::string place_text(const std::vector<Axis>& axes, const std::vector<double>& coordinates) {
  std::vector<std::string> places;
  for (std::size_t i = 0; i < axes.size(); ++i)
    places.push_back(quantity(axes[i], coordinate_text(axes[i], coordinates[i])));
  return fmt::format("{}", fmt::join(places, ", "));
}

}  // namespace sim
