#pragma once
// A result as a plain table, for spreadsheets and for programs that read no HDF5: a row a point of
// the sweep. Where all that a point has more than once lies along one dimension, as devices do, a
// row is an element of it at a point; of several dimensions each element has columns of its own.
// What belongs to no point, such as each frame heard, is left to HDF5.
#include <filesystem>
#include <string>

#include "sim/result/dataset.hpp"

namespace sim {

/// CSV as RFC 4180 has it: a line of names, then the rows. Numbers read back as they are; what is
/// not known is empty.
std::string result_as_csv(const Dataset& data);

/// JSON lines: an object a row, with the same names; what is not known is null.
std::string result_as_json_lines(const Dataset& data);

/// Whether it wrote the file.
bool is_csv_of_result(const std::filesystem::path& path);
bool are_json_lines_of_result(const std::filesystem::path& path);

}  // namespace sim
