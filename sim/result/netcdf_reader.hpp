#pragma once
// Reads what NetcdfFile wrote: cells of a variable, attributes of the file. One thread at a time.
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace sim {

/// What a file of this kind says it is ("cosys-sim result"); empty for any other.
std::string filetype_of(const std::filesystem::path& path);

/// Whether run wrote it, of whatever experiment.
bool is_result_of_run(const std::filesystem::path& path);

/// Throws Failure(bad_input), naming the file, of what is not there or cannot be read.
class NetcdfReader {
 public:
  explicit NetcdfReader(const std::filesystem::path& path);
  ~NetcdfReader();
  NetcdfReader(const NetcdfReader&) = delete;
  NetcdfReader& operator=(const NetcdfReader&) = delete;

  bool has(const std::string& variable) const;
  /// All cells of a variable, row-major.
  std::vector<std::int64_t> integers(const std::string& variable) const;
  std::vector<double> reals(const std::string& variable) const;
  std::vector<std::string> texts(const std::string& variable) const;

  /// The variables at the root, in the order of their names.
  std::vector<std::string> variables() const;
  /// The dimensions that a variable is on, in their order. Of a dimension's own coordinate none.
  std::vector<std::string> dimensions(const std::string& variable) const;
  bool is_dimension(const std::string& variable) const;
  bool is_text(const std::string& variable) const;
  bool is_integer(const std::string& variable) const;
  /// An attribute of a variable that is a text of ours; empty of one that it does not have.
  std::string text_of(const std::string& variable, const char* name) const;
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
