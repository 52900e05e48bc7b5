#pragma once
// How experiments that are not links say which of their points leave the range of a model
// (sim/link/validity).
#include <cstdint>
#include <string>
#include <vector>

#include "sim/report/text_table.hpp"
#include "sim/result/dataset.hpp"

namespace sim {

inline constexpr const char* outside_name = "outside_validity";

/// The last column of a table of points, and what stands in it: "! near", or nothing.
TextColumn outside_column();
std::string outside_mark(std::uint64_t mask);

/// The same in files, as the variable of that name; `masks`: of each point.
Dataset::Variable outside_variable(std::vector<std::int64_t> masks);

/// What the marks of all points mean, a line each.
std::string outside_notes(const Dataset& data);

}  // namespace sim
