#pragma once
// What an experiment says on stdout: a table whose rows can be printed one by one as points finish,
// or one JSON object. Numbers carry the digits that their interval supports; "-" is not known.
#include <string>
#include <vector>

#include "sim/result.hpp"

namespace sim {

/// Three lines (names and units), each ended by a newline.
std::string table_header(const std::vector<Axis>& axes);

/// One line, in the columns of table_header(axes).
std::string table_row(const std::vector<Axis>& axes, const PointResult& point, double ci_level);

/// All counts and rates of all points by the names of the result file; what is NaN is null.
std::string to_json(const ExperimentResult& result);

}  // namespace sim
