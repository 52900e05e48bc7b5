#include "sim/result/dataset.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>

#include "sim/failure.hpp"
#include "sim/result/netcdf_reader.hpp"
#include "sim/text/digest.hpp"
#include "sim/text/new_file.hpp"

namespace sim {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* dataset_root = NetcdfFile::root;

// ---- HDF5 ----

void add_axis(NetcdfFile& file, const Axis& axis) {
  const VariableFacts facts{dimension_name(axis.key), axis.unit, axis.long_name};
  if (axis.is_text())
    file.add_dimension(facts, std::span<const std::string>(axis.labels));
  else
    file.add_dimension(facts, std::span<const double>(axis.values));
}

template <class T>
std::span<const T> span_of(const std::vector<T>& values) {
  return values;
}

std::vector<std::string> dimensions_of(const Dataset& data, const Dataset::Variable& variable) {
  std::vector<std::string> names;
  if (variable.on_axes)
    for (const Axis& axis : data.axes) names.push_back(dimension_name(axis.key));
  names.insert(names.end(), variable.dimensions.begin(), variable.dimensions.end());
  return names;
}

void add_variable(NetcdfFile& file, const Dataset& data, const Dataset::Variable& variable) {
  std::visit(
      [&](const auto& values) {
        file.add_variable(variable.facts, dimensions_of(data, variable), span_of(values));
      },
      variable.values);
  if (!variable.flags.empty()) file.set_flags(variable.facts.name, variable.flags);
}

bool is_digested(const Dataset::Variable& variable) {
  return std::holds_alternative<std::vector<std::int64_t>>(variable.values) &&
         variable.flags.empty();
}

/// In the order in which the digest takes them.
std::string names_of_digested(const Dataset& data) {
  std::string names;
  for (const Dataset::Variable& variable : data.variables)
    if (is_digested(variable)) names += (names.empty() ? "" : " ") + variable.facts.name;
  return names;
}

void add_checkpoint(NetcdfFile& file, const std::string& checkpoint) {
  file.add_bytes(checkpoint_place,
                 {reinterpret_cast<const std::uint8_t*>(checkpoint.data()), checkpoint.size()});
  file.set_text(dataset_root, checkpoint_digest, digest_of(checkpoint));
}

std::string image_of(const Dataset& data, const ProgramInfo& program) {
  NetcdfFile file(experiment_result_type, program);
  for (const Axis& axis : data.axes) add_axis(file, axis);
  for (const Dataset::Dimension& d : data.dimensions)
    std::visit([&](const auto& values) { file.add_dimension(d.facts, span_of(values)); }, d.values);
  for (const Dataset::Variable& v : data.variables) add_variable(file, data, v);
  file.set_user_text(dataset_root, "title", data.title);
  file.set_user_text(dataset_root, "scenario_toml", data.scenario_toml);
  file.set_user_text(dataset_root, "command", data.command);
  file.set_text(dataset_root, "experiment", data.experiment);
  file.set_numbers(dataset_root, "seed", std::span<const std::uint64_t>(&data.seed, 1));
  file.set_text(dataset_root, "result_digest", dataset_digest(data));
  file.set_text(dataset_root, "digest_variables", names_of_digested(data));
  file.set_text(dataset_root, "shards", shards_text(data.shards));
  add_checkpoint(file, data.checkpoint);
  return file.image();
}

// ---- JSON ----

Json json_axis(const Axis& axis) {
  Json json{{"key", axis.key}, {"unit", axis.unit}, {"long_name", axis.long_name}};
  if (axis.is_text())
    json["values"] = axis.labels;
  else
    json["values"] = axis.values;
  return json;
}

Json json_variable(const Dataset& data, const Dataset::Variable& variable) {
  Json json{{"unit", variable.facts.unit},
            {"long_name", variable.facts.long_name},
            {"dimensions", dimensions_of(data, variable)}};
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

std::string dataset_digest(const Dataset& data) {
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

void write_dataset(const std::filesystem::path& path, const Dataset& data,
                   const ProgramInfo& program) {
  write_file(path, image_of(data, program));
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
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace sim
