#pragma once
// Starts for least squares: a grid over the area on which readings and prediction are compared by
// ratio, where 1/d^2 is smooth. Where it has a local minimum a descent begins. The grid depends on
// where receivers stand, not on what they read, so it serves many readings.
#include <vector>

#include "sim/location/gauss_newton.hpp"

namespace sim {

class SearchGrid {
 public:
  /// By rays alone: what the floor scatters is too slow to compute everywhere.
  SearchGrid(const LightModel& model, const std::vector<Reading>& readings, const Area& area);

  /// Local minima, the best first, `most_starts` at most. The readings are of the same receivers.
  std::vector<Unknowns> starts(const std::vector<Reading>& readings, bool intensity_unknown) const;

  static constexpr int nodes_a_side = 41;
  static constexpr std::size_t most_starts = 16;

 private:
  struct Node {
    Position at;
    std::vector<double> light;  // a reading each, W/m2; none where a receiver is too near
  };
  struct Score {
    double cost;
    double intensity;
  };
  Score score(const Node& node, const std::vector<Reading>& readings, bool intensity_unknown) const;
  bool is_lowest(const std::vector<Score>& scores, int column, int row) const;

  std::vector<Node> nodes_;  // row by row
};

}  // namespace sim
