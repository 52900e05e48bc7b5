#pragma once
// What NetcdfReader asks its ReadingProcess about an HDF5 file.
#include <cstddef>
#include <cstdint>
#include <string>

namespace sim {

/// What can be asked of a file, and the form of the answer. A text is ended by a zero byte, a
/// number is as it is in memory, and yes or no is a byte.
enum class Asked : std::uint8_t {
  opens,            // nothing, if it is an HDF5 file at all
  has_variable,     // yes or no
  variables,        // texts: the names at the root, in their order
  description,      // texts: "dimension" or "", "text", "integer" or "", units, long_name,
                    // flag_meanings, and of no dimension those that it is on
  size,             // std::uint64_t: cells of a variable on one dimension, 0 of any other
  integers,         // std::int64_t for each cell of a variable, row-major
  reals,            // double
  texts,            // texts
  bytes,            // std::uint8_t for `count` cells from `first` on, on one dimension
  floats,           // float
  has_attribute,    // yes or no; this and what follows are of the file
  attribute_text,   // its characters
  attribute_whole,  // std::uint64_t
  attribute_real    // double
};

struct Question {
  Asked what = Asked::opens;
  std::string name{};  // of a variable, or of an attribute
  std::uint64_t first = 0, count = 0;
};

/// No answer is longer. A result of a million points has 8 MB a variable.
constexpr std::size_t most_answer_bytes = std::size_t{1} << 28;

}  // namespace sim
