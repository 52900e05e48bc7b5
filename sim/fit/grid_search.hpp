#pragma once
// Costs of numbers on a grid.
#include <cstddef>
#include <initializer_list>
#include <vector>

#include "sim/fit/least_squares.hpp"

namespace sim {

/// A number and the values that a grid has of it; where there is a slope another number goes with
/// it.
struct GridAxis {
  std::size_t place;  // of the number
  std::vector<double> values;
  std::size_t other = 0;
  double slope = 0;

  void move(Numbers& x, double value) const;
};

struct GridPoint {
  double cost;
  Numbers x;
};

/// The best points of a grid around `x`, the best first; of equal ones the first of the grid.
std::vector<GridPoint> best_of_grid(const LeastSquaresProblem& problem, const Numbers& x,
                                    const std::vector<GridAxis>& axes, std::size_t wanted);

/// So many values with equal steps between them, the first and the last included.
std::vector<double> steps_between(double from, double to, int n);

std::vector<double> logarithms(std::initializer_list<double> values);

}  // namespace sim
