#include "sim/result/axis_json.hpp"

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

}  // namespace sim
