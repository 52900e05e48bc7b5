#pragma once
// An HDF5 file on the netCDF-4 model (a scale on each axis of each variable, text in coordinates
// only), so that xarray, ncdump and MATLAB open it. It is built in memory and becomes plain bytes.
// HDF5 is not safe for threads: one thread at a time.
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "sim/program_info.hpp"

namespace sim {

/// What every variable carries. An empty unit is written as "1".
struct VariableFacts {
  std::string name, unit, long_name;
};

/// One value for each cell, row-major. Of these types all but bytes have a value for "missing".
using Values = std::variant<std::span<const double>, std::span<const float>,
                            std::span<const std::int64_t>, std::span<const std::uint64_t>,
                            std::span<const std::int16_t>, std::span<const std::uint8_t>>;

/// What files say they are that run writes: of a link, and of other experiments.
constexpr const char* link_result_type = "cosys-sim result";
constexpr const char* experiment_result_type = "cosys-sim experiment";
/// And what trace writes.
constexpr const char* trace_type = "cosys-sim trace";

/// netCDF's own default fill value (netcdf.h).
constexpr std::int16_t missing_int16 = -32767;

class NetcdfFile {
 public:
  /// An empty file that says what it is ("cosys-sim result"), when and by whom it was written.
  NetcdfFile(const std::string& filetype, const ProgramInfo& program);
  ~NetcdfFile();
  NetcdfFile(const NetcdfFile&) = delete;
  NetcdfFile& operator=(const NetcdfFile&) = delete;

  /// A dimension and its coordinate; the name is that of both.
  void add_dimension(const VariableFacts& facts, std::span<const double> values);
  /// The same of texts: variable-length UTF-8.
  void add_dimension(const VariableFacts& facts, std::span<const std::string> texts);
  /// A variable on dimensions added before, in their order; none: one number.
  void add_variable(const VariableFacts& facts, const std::vector<std::string>& dimensions,
                    Values values);

  /// Bytes of the program's own, in a group of their own: those who open the file for its variables
  /// do not see them. `place` is GROUP/NAME.
  void add_bytes(const std::string& place, std::span<const std::uint8_t> bytes);

  /// Attributes of a variable, or of the file where the variable is `root`. A text of ours is
  /// ASCII; what a user wrote may be UTF-8 of any length.
  static constexpr const char* root = "/";
  static constexpr const char* format_version = "1.3";
  void set_text(const std::string& variable, const char* name, const std::string& text);
  void set_user_text(const std::string& variable, const char* name, const std::string& text);
  void set_numbers(const std::string& variable, const char* name, Values values);
  /// What the bits of a variable mean, from bit 0 on (CF conventions 1.11, 3.5).
  void set_flags(const std::string& variable, const std::vector<std::string>& names);
  /// What the values of a variable of int16 mean, from 0 on (the same section).
  void set_choices(const std::string& variable, const std::vector<std::string>& names);

  /// The whole file.
  std::string image() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sim
