#include "sim/result/axis_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace sim {

nlohmann::ordered_json json_axis(const Axis& axis) {
  nlohmann::ordered_json json{
      {"key", axis.key}, {"unit", axis.unit}, {"long_name", axis.long_name}};
  if (axis.is_text())
    json["values"] = axis.labels;
  else
    json["values"] = axis.values;
  return json;
}

nlohmann::ordered_json json_coordinate(const Axis& axis, double coordinate) {
  if (axis.is_text()) return axis.labels.at(static_cast<std::size_t>(coordinate));
  return coordinate;
}

nlohmann::ordered_json json_end(double end) {
  return std::isfinite(end) ? nlohmann::ordered_json(end) : nullptr;
}

}  // namespace sim
