#include "sim/counting/weighted.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sim {
namespace {

/// Below these a weighted mean is not told from one whose large weights were not drawn yet.
constexpr double least_effective_size = 20;
constexpr double largest_share = 0.2;

}  // namespace

WeightedSum& WeightedSum::operator+=(const WeightedSum& o) {
  sum += o.sum;
  squares += o.squares;
  largest = std::max(largest, o.largest);
  group_squares += o.group_squares;
  return *this;
}

double WeightedSum::effective_size() const { return squares > 0 ? sum * sum / squares : 0; }

double WeightedSum::coefficient_of_variation(double groups) const {
  if (!(sum > 0) || groups < 2) return std::numeric_limits<double>::quiet_NaN();
  return std::sqrt(std::max(0.0, groups * group_squares / (sum * sum) - 1) / (groups - 1));
}

bool WeightedSum::is_sound() const {
  return effective_size() >= least_effective_size && largest <= largest_share * sum;
}

WeightedSum weighted_sum(std::span<const double> x) {
  WeightedSum of;
  for (const double one : x) {
    of.sum += one;
    of.squares += one * one;
    of.largest = std::max(of.largest, one);
  }
  of.group_squares = of.sum * of.sum;
  return of;
}

Weighted& Weighted::operator+=(const Weighted& o) {
  n_groups += o.n_groups;
  bit_errors += o.bit_errors;
  frames_lost += o.frames_lost;
  dark_likelihood += o.dark_likelihood;
  return *this;
}

}  // namespace sim
