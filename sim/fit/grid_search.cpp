#include "sim/fit/grid_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/fit/lowest_costs.hpp"

namespace sim {

void GridAxis::move(Numbers& x, double value) const {
  if (slope != 0) x[other] += slope * (value - x[place]);
  x[place] = value;
}

std::vector<GridPoint> best_of_grid(const LeastSquaresProblem& problem, const Numbers& x,
                                    const std::vector<GridAxis>& axes, std::size_t wanted) {
  std::size_t all = 1;
  for (const GridAxis& axis : axes) all *= axis.values.size();
  std::vector<GridPoint> points;
  LowestCosts lowest(wanted);
  for (std::size_t i = 0; i < all; ++i) {
    Numbers at = x;
    std::size_t rest = i;
    for (const GridAxis& axis : axes) {
      axis.move(at, axis.values[rest % axis.values.size()]);
      rest /= axis.values.size();
    }
    const double cost = cost_of(problem, at, lowest.most());
    lowest.add(cost);
    points.push_back({cost, std::move(at)});
  }
  std::ranges::stable_sort(points, {}, &GridPoint::cost);
  points.resize(std::min(points.size(), wanted));
  return points;
}

std::vector<double> steps_between(double from, double to, int n) {
  std::vector<double> values;
  for (int i = 0; i < n; ++i) values.push_back(from + (to - from) * i / (n - 1));
  return values;
}

std::vector<double> logarithms(std::initializer_list<double> values) {
  std::vector<double> all;
  for (const double value : values) all.push_back(std::log(value));
  return all;
}

}  // namespace sim
