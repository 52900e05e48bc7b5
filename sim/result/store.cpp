#include "sim/result/store.hpp"

#include <map>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "sim/failure.hpp"
#include "sim/result/netcdf.hpp"
#include "sim/result/netcdf_reader.hpp"
#include "sim/result/result_table.hpp"
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

std::string csv_of(const Dataset& data, const ProgramInfo&) { return result_as_csv(data); }

std::string json_lines_of(const Dataset& data, const ProgramInfo&) {
  return result_as_json_lines(data);
}

struct ResultFormat {
  std::string (*contents)(const Dataset&, const ProgramInfo&);
  OwnFiles own;
  bool is_read_back;  // by --resume, merge, report and diff
};

constexpr const char* own_result = "a result of cosys-sim";

/// By the ending of the name; HDF5 where it has none.
const std::map<std::string, ResultFormat>& formats() {
  static const ResultFormat hdf5{image_of, {is_result_of_run, own_result}, true};
  static const std::map<std::string, ResultFormat> all{
      {"", hdf5},
      {".h5", hdf5},
      {".hdf5", hdf5},
      {".nc", hdf5},
      {".csv", {csv_of, {is_csv_of_result, own_result}, false}},
      {".json", {json_lines_of, {are_json_lines_of_result, own_result}, false}}};
  return all;
}

const ResultFormat& result_format_of(const std::filesystem::path& path) {
  const auto found = formats().find(path.extension().string());
  if (found == formats().end())
    throw bad_input("cannot write a result into " + path.string(), "its ending names no format",
                    "end the name in .h5, .csv or .json (JSON lines)");
  return found->second;
}

}  // namespace

void write_dataset(const std::filesystem::path& path, const Dataset& data,
                   const ProgramInfo& program) {
  write_file(path, result_format_of(path).contents(data, program));
}

void check_writable(const std::filesystem::path& path) {
  check_place(path, result_format_of(path).own);
}

bool ends_as_result(const std::filesystem::path& path) {
  return path.has_extension() && formats().contains(path.extension().string());
}

void check_read_back(const std::filesystem::path& path, const std::string& by) {
  if (!result_format_of(path).is_read_back)
    throw bad_input(by + " with " + path.string(), "a table keeps no trials to go on with",
                    "write to a name that ends in .h5; cosys-sim merge FILE.h5 -o " +
                        path.filename().string() + " makes a table of it");
}

}  // namespace sim
