#pragma once
// The least cost of numbers with which a cost jumps, and has many minima: where a search along
// slopes may begin.
#include <vector>

#include "sim/fit/least_squares.hpp"

namespace sim {

/// A number that is searched, and where.
struct SearchedNumber {
  std::size_t place = 0;  // in the problem's numbers
  double low = 0, high = 0;
};

/// `start` with the searched numbers of the least cost that was met. Controlled random search
/// (P. Kaelo and M. M. Ali, "Some variants of the controlled random search algorithm for global
/// optimization", 2006; NLopt's CRS2_LM). The same each time, of one seed.
Numbers global_search(const LeastSquaresProblem& problem, const Numbers& start,
                      const std::vector<SearchedNumber>& numbers, int evaluations,
                      unsigned long seed);

}  // namespace sim
