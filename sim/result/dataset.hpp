#pragma once
// Dataset: what an experiment leaves behind, as variables on axes and on dimensions of its own
// (devices, frames heard). One writer for HDF5 serves all, and one for JSON all but links.
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "sim/counting/shard.hpp"
#include "sim/result/netcdf.hpp"
#include "sim/scenario/axis.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

struct Dataset {
  /// Besides the axes.
  struct Dimension {
    VariableFacts facts;
    std::variant<std::vector<std::string>, std::vector<double>> values;
    std::size_t size() const {
      return std::visit([](const auto& v) { return v.size(); }, values);
    }
  };
  struct Attribute {
    std::string name;
    std::variant<std::string, double> value;
  };
  /// Row-major. Whole numbers are counts, of which the digest is made, or flags, or choices; a NaN
  /// means: not known.
  struct Variable {
    VariableFacts facts;
    bool on_axes = true;                  // one value a point at least
    std::vector<std::string> dimensions;  // behind the axes, by the names of their facts
    std::variant<std::vector<double>, std::vector<std::int64_t>> values;
    std::vector<std::string> flags{};  // what the bits of whole numbers mean, from bit 0 on
    bool is_choice = false;            // whole numbers are indices of `flags`, or no_choice
    std::vector<Attribute> attributes{};
  };

  std::string title, scenario_toml, command, experiment;
  std::uint64_t seed = 0;
  std::vector<Axis> axes;
  std::vector<Dimension> dimensions{};
  std::vector<Variable> variables{};
  std::uint64_t n_runs = 0;       // or trials, of all points together; 0: nothing was measured
  std::vector<Shard> shards{{}};  // of the runs, which it has
  /// What its runs counted as the program adds it up, for going on and for merging; empty in files
  /// of earlier versions.
  std::string checkpoint{};
  std::vector<Attribute> attributes{};  // of the file
  std::string
      digest{};  // of a link (result_digest); empty: dataset_digest() makes it of all counts
};

/// A choice that is not known.
inline constexpr std::int64_t no_choice = missing_int16;

/// Where a file keeps the checkpoint, and the attribute with its digest.
inline constexpr const char *checkpoint_group = "checkpoint", *checkpoint_place = "checkpoint/runs",
                            *checkpoint_digest = "checkpoint_digest";

/// With the scenario's facts and nothing measured yet.
Dataset dataset_of(const LoadedScenario& scenario, const std::string& command);

/// Hash (32 hex digits) of all counts: equal digests, equal results. Where the dataset has one of
/// its own, that.
std::string dataset_digest(const Dataset& data);

/// Whether the digest is made of it.
bool is_digested(const Dataset::Variable& variable);

/// All dimensions of a variable, the axes first.
std::vector<std::string> names_of_dimensions(const Dataset& data,
                                             const Dataset::Variable& variable);

/// Null where there is none of that name.
const Dataset::Variable* find_variable(const Dataset& data, const std::string& name);

/// Its cells, row-major.
std::vector<double> numbers_of(const Dataset::Variable& variable);

/// Those of the variable of that name; empty where there is none.
std::vector<double> numbers_named(const Dataset& data, const std::string& name);

/// The dimension of that name. Throws bad_input where there is none: a file may be damaged.
const Dataset::Dimension& dimension_named(const Dataset& data, const std::string& name);

/// An element of a dimension: its text, or the number in up to six digits.
std::string value_text(const Dataset::Dimension& dimension, std::size_t i);

/// How many cells it has at each point: those of its dimensions behind the axes.
std::size_t cells_a_point(const Dataset& data, const Dataset::Variable& variable);

std::string dataset_json(const Dataset& data);

}  // namespace sim
