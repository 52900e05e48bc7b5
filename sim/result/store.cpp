#include "sim/result/store.hpp"

#include <span>
#include <string>
#include <variant>
#include <vector>

#include "sim/result/netcdf.hpp"
#include "sim/result/netcdf_reader.hpp"
#include "sim/scenario/experiment_kind.hpp"
#include "sim/text/digest.hpp"
#include "sim/text/new_file.hpp"

namespace sim {
namespace {

constexpr const char* root = NetcdfFile::root;

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

void set(NetcdfFile& file, const std::string& of, const Dataset::Attribute& attribute) {
  if (const auto* text = std::get_if<std::string>(&attribute.value))
    return file.set_text(of, attribute.name.c_str(), *text);
  file.set_numbers(of, attribute.name.c_str(), std::span(&std::get<double>(attribute.value), 1));
}

void add_choices(NetcdfFile& file, const Dataset& data, const Dataset::Variable& variable) {
  const auto& numbers = std::get<std::vector<std::int64_t>>(variable.values);
  const std::vector<std::int16_t> values(numbers.begin(), numbers.end());
  file.add_variable(variable.facts, names_of_dimensions(data, variable), span_of(values));
  file.set_choices(variable.facts.name, variable.flags);
}

void add_variable(NetcdfFile& file, const Dataset& data, const Dataset::Variable& variable) {
  if (variable.is_choice) return add_choices(file, data, variable);
  std::visit(
      [&](const auto& values) {
        file.add_variable(variable.facts, names_of_dimensions(data, variable), span_of(values));
      },
      variable.values);
  if (!variable.flags.empty()) file.set_flags(variable.facts.name, variable.flags);
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
  file.set_text(root, checkpoint_digest, digest_of(checkpoint));
}

std::string image_of(const Dataset& data, const ProgramInfo& program) {
  NetcdfFile file(data.experiment == link_kind.name ? link_result_type : experiment_result_type,
                  program);
  for (const Axis& axis : data.axes) add_axis(file, axis);
  for (const Dataset::Dimension& d : data.dimensions)
    std::visit([&](const auto& values) { file.add_dimension(d.facts, span_of(values)); }, d.values);
  for (const Dataset::Variable& v : data.variables) {
    add_variable(file, data, v);
    for (const Dataset::Attribute& attribute : v.attributes) set(file, v.facts.name, attribute);
  }
  file.set_user_text(root, "title", data.title);
  file.set_user_text(root, "scenario_toml", data.scenario_toml);
  file.set_user_text(root, "command", data.command);
  file.set_text(root, "experiment", data.experiment);
  file.set_numbers(root, "seed", std::span<const std::uint64_t>(&data.seed, 1));
  file.set_text(root, "result_digest", dataset_digest(data));
  if (data.digest.empty()) file.set_text(root, "digest_variables", names_of_digested(data));
  file.set_text(root, "shards", shards_text(data.shards));
  for (const Dataset::Attribute& attribute : data.attributes) set(file, root, attribute);
  if (!data.checkpoint.empty()) add_checkpoint(file, data.checkpoint);
  return file.image();
}

}  // namespace

void write_dataset(const std::filesystem::path& path, const Dataset& data,
                   const ProgramInfo& program) {
  write_file(path, image_of(data, program));
}

void check_writable(const std::filesystem::path& path) {
  check_place(path, {is_result_of_run, "a result of cosys-sim"});
}

}  // namespace sim
