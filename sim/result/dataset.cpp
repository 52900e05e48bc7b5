#include "sim/result/dataset.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "sim/failure.hpp"
#include "sim/result/axis_json.hpp"
#include "sim/result/unit_spread_json.hpp"
#include "sim/text/digest.hpp"
#include "sim/text/json_answer.hpp"

namespace sim {
namespace {

using Json = nlohmann::ordered_json;

Json json_variable(const Dataset& data, const Dataset::Variable& variable) {
  Json json{{"unit", variable.facts.unit},
            {"long_name", variable.facts.long_name},
            {"dimensions", names_of_dimensions(data, variable)}};
  if (variable.is_choice) {
    json["values"] = Json::array();
    for (const std::int64_t choice : std::get<std::vector<std::int64_t>>(variable.values))
      json["values"].push_back(choice == no_choice
                                   ? Json(nullptr)
                                   : Json(variable.flags.at(static_cast<std::size_t>(choice))));
    return json;
  }
  std::visit([&](const auto& values) { json["values"] = values; }, variable.values);
  if (!variable.flags.empty()) json["flags"] = variable.flags;
  return json;
}

}  // namespace

Dataset dataset_of(const LoadedScenario& scenario, const std::string& command) {
  return {.title = scenario.base.title,
          .scenario_toml = scenario.text,
          .command = command,
          .experiment = scenario.base.experiment,
          .seed = static_cast<std::uint64_t>(scenario.base.simulation.seed),
          .axes = scenario.sweep};
}

bool is_digested(const Dataset::Variable& variable) {
  return std::holds_alternative<std::vector<std::int64_t>>(variable.values) &&
         variable.flags.empty();
}

std::vector<std::string> names_of_dimensions(const Dataset& data,
                                             const Dataset::Variable& variable) {
  std::vector<std::string> names;
  if (variable.on_axes)
    for (const Axis& axis : data.axes) names.push_back(dimension_name(axis.key));
  names.insert(names.end(), variable.dimensions.begin(), variable.dimensions.end());
  return names;
}

std::string dataset_digest(const Dataset& data) {
  if (!data.digest.empty()) return data.digest;
  std::string bytes;
  for (const Dataset::Variable& variable : data.variables) {
    if (!is_digested(variable)) continue;
    bytes += variable.facts.name;
    for (std::int64_t count : std::get<std::vector<std::int64_t>>(variable.values))
      for (int i = 0; i < 8; ++i, count >>= 8) bytes += static_cast<char>(count & 0xff);
  }
  return digest_of(bytes);
}

const Dataset::Variable* find_variable(const Dataset& data, const std::string& name) {
  for (const Dataset::Variable& variable : data.variables)
    if (variable.facts.name == name) return &variable;
  return nullptr;
}

std::vector<double> numbers_of(const Dataset::Variable& variable) {
  return std::visit(
      [](const auto& values) { return std::vector<double>(values.begin(), values.end()); },
      variable.values);
}

std::vector<double> numbers_named(const Dataset& data, const std::string& name) {
  const Dataset::Variable* variable = find_variable(data, name);
  return variable == nullptr ? std::vector<double>() : numbers_of(*variable);
}

const Dataset::Dimension& dimension_named(const Dataset& data, const std::string& name) {
  const auto found =
      std::ranges::find(data.dimensions, name, [](const auto& d) { return d.facts.name; });
  if (found == data.dimensions.end())
    throw bad_input("the result", fmt::format("it has no dimension {}: it is damaged", name),
                    "choose another file");
  return *found;
}

std::string value_text(const Dataset::Dimension& dimension, std::size_t i) {
  if (const auto* texts = std::get_if<std::vector<std::string>>(&dimension.values))
    return (*texts)[i];
  return fmt::format("{:g}", std::get<std::vector<double>>(dimension.values)[i]);
}

std::size_t cells_a_point(const Dataset& data, const Dataset::Variable& variable) {
  std::size_t cells = 1;
  for (const std::string& name : variable.dimensions) cells *= dimension_named(data, name).size();
  return cells;
}

std::string dataset_json(const Dataset& data) {
  Json json{{"title", data.title},
            {"experiment", data.experiment},
            {"command", data.command},
            {"seed", data.seed},
            {"shards", shards_text(data.shards)},
            {"result_digest", dataset_digest(data)}};
  json["axes"] = Json::array();
  for (const Axis& axis : data.axes) json["axes"].push_back(json_axis(axis));
  json["dimensions"] = Json::object();
  for (const Dataset::Dimension& d : data.dimensions)
    std::visit([&](const auto& values) { json["dimensions"][d.facts.name] = values; }, d.values);
  json["variables"] = Json::object();
  for (const Dataset::Variable& v : data.variables)
    json["variables"][v.facts.name] = json_variable(data, v);
  if (const auto units = unit_spread(data)) json["units"] = json_units(*units);
  return json_page(json);
}

}  // namespace sim
