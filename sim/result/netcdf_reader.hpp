#pragma once
// Reads what NetcdfFile wrote: cells of a variable, attributes of the file. One thread at a time.
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sim/result/netcdf.hpp"

namespace sim {

/// What a file of this kind says it is ("cosys-sim result"); empty for any other.
std::string filetype_of(const std::filesystem::path& path);

/// Whether run wrote it, of whatever experiment.
bool is_result_of_run(const std::filesystem::path& path);

struct VariableDescription {
  VariableFacts facts;
  std::string flag_meanings;  // empty where it has none
  bool is_dimension = false, is_text = false, is_integer = false;
  std::vector<std::string> dimensions;  // those that it is on, in their order; of a dimension none
};

/// Throws Failure(bad_input), naming the file, of what is not there or cannot be read.
class NetcdfReader {
 public:
  explicit NetcdfReader(const std::filesystem::path& path);
  ~NetcdfReader();
  NetcdfReader(const NetcdfReader&) = delete;
  NetcdfReader& operator=(const NetcdfReader&) = delete;

  /// A variable, or a group.
  bool has(const std::string& name) const;
  /// All cells of a variable, row-major.
  std::vector<std::int64_t> integers(const std::string& variable) const;
  std::vector<double> reals(const std::string& variable) const;
  std::vector<std::string> texts(const std::string& variable) const;

  /// The variables at the root, in the order of their names.
  std::vector<std::string> variables() const;
  VariableDescription description(const std::string& variable) const;
  /// Cells of a variable on one dimension; 0 of any other.
  std::size_t size(const std::string& variable) const;
  /// The cells of such a variable from `first` on: as many as there is room for, which it must
  /// have.
  void read(const std::string& variable, std::size_t first, std::span<std::uint8_t> to) const;
  void read(const std::string& variable, std::size_t first, std::span<float> to) const;

  /// An attribute of the file: ours, or a text of the user's.
  std::string text(const char* name) const;
  /// The same, or `otherwise` of a file that does not have it.
  std::string text(const char* name, const char* otherwise) const;
  std::uint64_t whole_number(const char* name) const;
  double real_number(const char* name) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sim
