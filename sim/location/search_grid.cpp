#include "sim/location/search_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace sim {
namespace {

constexpr int side = SearchGrid::nodes_a_side;

/// A misfit of the search: so many nepers of light, so many radians of bearing. Nodes are so far
/// apart that deviations mean nothing to them.
constexpr double search_nepers = 0.3, search_radians = 0.3;

double lerp_node(double low, double high, int i) {
  return std::lerp(low, high, static_cast<double>(i) / (side - 1));
}

std::size_t index(int column, int row) {
  return static_cast<std::size_t>(row) * side + static_cast<std::size_t>(column);
}

/// Measured over predicted light in nepers; what is less than a deviation counts as one.
double log_ratio(const Reading& reading, double light) {
  const double least = reading.deviation_w_per_m2;
  return std::log(std::max(reading.irradiance_w_per_m2, least) / std::max(light, least));
}

}  // namespace

SearchGrid::SearchGrid(const LightModel& model, const std::vector<Reading>& readings,
                       const Area& area) {
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      Node node{{lerp_node(area.x_min, area.x_max, column), lerp_node(area.y_min, area.y_max, row)},
                {}};
      if (nearest_receiver(readings, node.at) >= least_distance_m)
        for (const Reading& reading : readings)
          node.light.push_back(ray_light(model, node.at, reading.receiver));
      nodes_.push_back(std::move(node));
    }
}

std::vector<Unknowns> SearchGrid::starts(const std::vector<Reading>& readings,
                                         bool intensity_unknown) const {
  std::vector<Score> scores;
  for (const Node& node : nodes_) scores.push_back(score(node, readings, intensity_unknown));
  std::vector<std::size_t> lowest;
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column)
      if (is_lowest(scores, column, row)) lowest.push_back(index(column, row));
  std::ranges::stable_sort(lowest, {}, [&](std::size_t i) { return scores[i].cost; });
  lowest.resize(std::min(lowest.size(), most_starts));
  std::vector<Unknowns> starts;
  for (const std::size_t i : lowest) starts.push_back({nodes_[i].at, scores[i].intensity});
  return starts;
}

SearchGrid::Score SearchGrid::score(const Node& node, const std::vector<Reading>& readings,
                                    bool intensity_unknown) const {
  if (node.light.empty()) return {std::numeric_limits<double>::infinity(), 1};
  std::vector<double> ratios;
  for (std::size_t i = 0; i < readings.size(); ++i)
    ratios.push_back(log_ratio(readings[i], node.light[i]));
  const double offset = intensity_unknown ? std::reduce(ratios.begin(), ratios.end()) /
                                                static_cast<double>(ratios.size())
                                          : 0;
  double cost = 0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    cost += std::pow((ratios[i] - offset) / search_nepers, 2);
    if (readings[i].has_bearing())
      cost += std::pow(bearing_error(readings[i], node.at) / search_radians, 2);
  }
  return {cost, std::exp(offset)};
}

bool SearchGrid::is_lowest(const std::vector<Score>& scores, int column, int row) const {
  const double here = scores[index(column, row)].cost;
  if (std::isinf(here)) return false;
  for (int y = std::max(row - 1, 0); y <= std::min(row + 1, side - 1); ++y)
    for (int x = std::max(column - 1, 0); x <= std::min(column + 1, side - 1); ++x)
      if (scores[index(x, y)].cost < here) return false;
  return true;
}

}  // namespace sim
