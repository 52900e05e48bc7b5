#pragma once
#include <string>
#include <vector>

namespace sim {

/// One swept key. The points of a grid are ordered row-major: the last axis varies fastest.
struct Axis {
  std::string key;                    // "receiver.range_m"
  std::string unit;                   // "m"; empty for texts (the file says "1")
  std::string long_name;              // "distance along the floor"
  std::vector<double> values;         // of texts 0, 1, 2...: which of them
  std::vector<std::string> labels{};  // the texts: "TSOP4856"; none for numbers

  bool is_text() const { return !labels.empty(); }
};

/// The axis of drawn units, along which nothing rises or falls.
inline constexpr const char* unit_key = "receiver.unit";

/// A value of the axis as tables show it: its text, or the number in up to six digits.
std::string coordinate_text(const Axis& axis, double coordinate);

/// What the result file calls the dimension of a key: "receiver_range_m".
std::string dimension_name(const std::string& key);

/// Throws bad_input if two axes have one such name.
void check_dimension_names(const std::vector<Axis>& axes);

}  // namespace sim
