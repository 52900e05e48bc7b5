#pragma once
// The table of all points of a link's result, and which of them are marked in it.
#include <string>
#include <vector>

#include "sim/page/page.hpp"
#include "sim/result/result.hpp"

namespace sim {

/// The columns of `run` with irradiance and SNR, theory where there is one, and marks of what to
/// heed in the last, which are explained.
PageSection numbers_section(const ExperimentResult& result);

inline constexpr const char* outside_words = "outside of what a model is valid for";

/// "Marked in the table of all numbers: of 5 points 2 with an alarm."; empty without marks.
std::string marked_line(std::size_t points, const std::vector<std::string>& marks);

/// A sentence of how many points are marked, as their table is far below; empty of none.
std::string marked_points(const ExperimentResult& result);

}  // namespace sim
