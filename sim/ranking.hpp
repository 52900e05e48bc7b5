#pragma once
// Ranking: where the frame loss passes a level along one axis, for each value of the other. With
// texts as the other axis ("which module do I buy?") it is sorted, best first.
#include <cstdint>
#include <string>
#include <vector>

#include "sim/curve_fit.hpp"
#include "sim/result.hpp"

namespace sim {

/// One line across the grid: the other axis' value stands still.
struct RowCrossing {
  std::size_t row;  // index of that value; 0 where there is one axis only
  Crossing crossing;
  std::uint64_t outside;  // limits of validity that any of its points leaves
};

struct Ranking {
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::size_t abscissa = none;  // index of the axis along which the loss passes the level
  std::size_t other = none;     // index of the other axis; `none` where there is one only
  std::vector<RowCrossing> rows;
};

/// For one axis of numbers, or two, of which one may be texts; for any other sweep empty. Of two
/// axes of numbers the last is the abscissa. Rows of texts are sorted: first those that never pass
/// the level, then by the crossing (its middle, where only a bracket is known), the one that is
/// reached last first; then those of which no crossing can be told, and last those beyond the level
/// at all points.
Ranking rank(const ExperimentResult& result, double level = 0.01);

/// The ranking in words, one line a row; empty where there is nothing to say.
std::string ranking_lines(const ExperimentResult& result, const Ranking& ranking,
                          double level = 0.01);

}  // namespace sim
