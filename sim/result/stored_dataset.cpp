#include "sim/result/stored_dataset.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>
#include <utility>

#include "sim/failure.hpp"
#include "sim/result/netcdf_reader.hpp"
#include "sim/result/stored_result.hpp"
#include "sim/scenario/experiment_kind.hpp"
#include "sim/scenario/sweep.hpp"
#include "sim/text/digest.hpp"

namespace sim {
namespace {

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

Dataset::Dimension dimension_of(const NetcdfReader& file, const VariableDescription& found) {
  if (found.is_text) return {found.facts, file.texts(found.facts.name)};
  return {found.facts, file.reals(found.facts.name)};
}

/// Splits those that it is on into axes, all of them or none, and others.
Dataset::Variable variable_of(const NetcdfReader& file, const VariableDescription& found,
                              const std::vector<std::string>& axes) {
  Dataset::Variable variable{
      found.facts, false, found.dimensions, {}, words_of(found.flag_meanings)};
  std::vector<std::string>& dimensions = variable.dimensions;
  variable.on_axes =
      dimensions.size() >= axes.size() && std::equal(axes.begin(), axes.end(), dimensions.begin());
  if (variable.on_axes) dimensions.erase(dimensions.begin(), dimensions.begin() + std::ssize(axes));
  if (found.is_integer)
    variable.values = file.integers(found.facts.name);
  else
    variable.values = file.reals(found.facts.name);
  return variable;
}

void read_variables(const NetcdfReader& file, Dataset& data) {
  std::vector<std::string> axes;
  for (const Axis& axis : data.axes) axes.push_back(dimension_name(axis.key));
  for (const std::string& name : file.variables()) {
    if (std::ranges::find(axes, name) != axes.end()) continue;
    const VariableDescription found = file.description(name);
    if (found.is_dimension)
      data.dimensions.push_back(dimension_of(file, found));
    else
      data.variables.push_back(variable_of(file, found, axes));
  }
}

/// Those that the digest is made of first, in its order.
void put_in_order(Dataset& data, const std::vector<std::string>& digested) {
  std::ranges::stable_sort(data.variables, {}, [&](const Dataset::Variable& variable) {
    return std::ranges::find(digested, variable.facts.name) - digested.begin();
  });
}

bool knows_dimensions(const Dataset& data, const Dataset::Variable& variable) {
  return std::ranges::all_of(variable.dimensions, [&](const std::string& name) {
    return std::ranges::any_of(data.dimensions,
                               [&](const auto& dimension) { return dimension.facts.name == name; });
  });
}

bool has_all_cells(const Dataset& data, const Dataset::Variable& variable) {
  return knows_dimensions(data, variable) &&
         numbers_of(variable).size() ==
             (variable.on_axes ? count_points(data.axes) : 1) * cells_a_point(data, variable);
}

bool has_all_cells(const Dataset& data) {
  return std::ranges::all_of(data.variables,
                             [&](const auto& variable) { return has_all_cells(data, variable); });
}

bool has_numbers(const Dataset::Dimension& dimension) {
  const auto* numbers = std::get_if<std::vector<double>>(&dimension.values);
  return numbers == nullptr ||
         std::ranges::all_of(*numbers, [](double number) { return std::isfinite(number); });
}

void check(const StoredDataset& stored, const NetcdfReader& file, const std::string& digested,
           const std::filesystem::path& path) {
  const auto refuse = [&](const char* why) {
    throw bad_input(path.string(), std::string(why) + ": it is damaged", "choose another file");
  };
  if (file.text("experiment") != stored.scenario.base.experiment)
    refuse("its scenario is of another experiment");
  if (stored.scenario.base.experiment == link_kind.name)
    refuse("results of links are of another type");
  if (!has_all_cells(stored.data)) refuse("its variables do not fit its sweep");
  if (!std::ranges::all_of(stored.data.dimensions, has_numbers))
    refuse("a dimension has an element that is no number");
  if (!find_variable(stored.data, "n_runs") && !find_variable(stored.data, "n_trials"))
    refuse("it does not say how many runs it has");
  if (!digested.empty() && dataset_digest(stored.data) != file.text("result_digest"))
    refuse("its counts do not fit its digest");
}

/// Runs or trials of all points.
std::uint64_t runs_in(const Dataset& data) {
  double sum = 0;
  for (const char* name : {"n_runs", "n_trials"})
    if (const Dataset::Variable* variable = find_variable(data, name))
      for (const double runs : numbers_of(*variable)) sum += std::max(0.0, runs);
  constexpr double most = 1e18;
  return static_cast<std::uint64_t>(std::min(sum, most));
}

std::vector<Shard> shards_in(const NetcdfReader& file, const std::filesystem::path& path) {
  const auto shards = shards_of(file);
  if (!shards || shards->empty())
    throw bad_input(path.string(), "it does not say which runs it has: it is damaged",
                    "choose another file");
  return *shards;
}

}  // namespace

StoredDataset read_dataset(const std::filesystem::path& path) {
  const NetcdfReader file(path);
  const Origin origin = origin_of(file);
  StoredDataset stored{readable_scenario(origin, path), {}, origin};
  stored.data = dataset_of(stored.scenario, file.text("command"));
  stored.data.scenario_toml = origin.scenario_toml;
  stored.data.shards = shards_in(file, path);
  read_variables(file, stored.data);
  const std::string digested = file.text("digest_variables", "");  // older files do not have it
  put_in_order(stored.data, words_of(digested));
  check(stored, file, digested, path);
  stored.data.n_runs = runs_in(stored.data);
  return stored;
}

std::string read_checkpoint(const std::filesystem::path& path) {
  const NetcdfReader file(path);
  if (!file.has(checkpoint_group))
    throw bad_input(path.string(), "it keeps no counts that can be gone on with or added up",
                    "run it again with this version");
  constexpr std::size_t piece = 1 << 23;  // each has a second to be read in
  const std::size_t size = file.size(checkpoint_place);
  std::string bytes;
  while (bytes.size() < size) {
    const std::size_t first = bytes.size(), n = std::min(piece, size - first);
    bytes.resize(first + n);
    file.read(checkpoint_place, first, {reinterpret_cast<std::uint8_t*>(bytes.data()) + first, n});
  }
  if (digest_of(bytes) != file.text(checkpoint_digest))
    throw bad_input(path.string(), "its counts do not fit their digest: it is damaged",
                    "choose another file");
  return bytes;
}

}  // namespace sim
