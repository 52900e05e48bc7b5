#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace sim {

inline constexpr const char* outside_words = "outside of what a model is valid for";

/// "Marked in the table of all numbers: of 5 points 2 with an alarm."; empty without marks.
std::string marked_line(std::size_t points, const std::vector<std::string>& marks);

}  // namespace sim
