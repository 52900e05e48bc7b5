#pragma once
// Ranking: where the frame loss passes a level along one axis, for each combination of values of
// the others. With texts among the others ("which module do I buy?") it is sorted, best first, for
// each combination of their numbers.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/result/curve_fit.hpp"
#include "sim/result/result.hpp"
#include "sim/result/unit_range.hpp"

namespace sim {

/// The key along which users ask how far.
inline constexpr const char* distance_key = "receiver.range_m";

/// One line across the grid: the other axes stand still.
struct RowCrossing {
  std::vector<double> others;  // their coordinates, in the order of Ranking::others
  Crossing crossing;
  std::uint64_t validity_flags;       // limits of validity that any of its points leaves
  double merit = 0;                   // larger is better, also between rankings along one key
  std::optional<RangeDoubt> doubt{};  // of the crossing, where one is known of
  std::size_t place = 0;  // from 1, the same for equals; 0: none, not sorted or unfinished
};

/// What is asked: along which axis the loss passes which level.
struct CrossingQuestion {
  double flr = 0.01;
  std::string along{};  // its key; empty: distance_key, or else the last axis of numbers
};

struct Ranking {
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::size_t abscissa = none;      // index of the axis along which the loss passes the level
  std::vector<std::size_t> others;  // indices of the other axes
  double flr = 0.01;                // the level
  bool best_first = false;          // in the order of the grid otherwise
  bool more_is_better = false;      // more of the abscissa means less loss, all rows together
  std::vector<RowCrossing> rows;
};

/// Whether more of a key means less loss, where that is known of every link; else nothing.
std::optional<bool> known_direction(const std::string& key);

/// The axis along which a loss is looked for: that of the key, if one is named. Else distance where
/// it is swept, as it is what users ask for, or else the last axis of numbers; Ranking::none where
/// there is none.
std::size_t abscissa_of(const std::vector<Axis>& axes, const std::string& named = "");

/// Of a sweep without an axis of numbers the ranking is empty. Sorted rows: first those that never
/// pass the level, then by the crossing (its middle, where only a bracket is known), the one that
/// is reached last first; then those of which no crossing can be told, those beyond the level at
/// all points, and last, without a place, those that are not counted far enough. Of equals the ones
/// that no limit of validity flags come first. Empty for weighted results.
Ranking rank(const LinkResult& result, const CrossingQuestion& question = {});

/// The same result with the values of its axis of texts in the order of its ranking, where that
/// goes best first and there is no axis but these texts and that of the loss; else as it is.
LinkResult best_first(const LinkResult& result, const Ranking& ranking);

/// The ranking in words, one line a row, and one that says what a doubt is; empty where there is
/// nothing to say.
std::string ranking_lines(const LinkResult& result, const Ranking& ranking);

}  // namespace sim
