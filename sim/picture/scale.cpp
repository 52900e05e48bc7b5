#include "sim/picture/scale.hpp"

#include <cassert>
#include <cmath>

namespace sim {
namespace {

/// The least of 1, 2, 5 times a power of ten that is not below `least`.
double round_step(double least) {
  const double decade = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * decade >= least * (1 - 1e-9)) return factor * decade;
  return 10 * decade;
}

}  // namespace

std::vector<double> round_values(double from, double to, int most) {
  assert(from < to && most >= 2);
  const double step = round_step((to - from) / (most - 1));
  const double slack = 1e-9 * (to - from);
  std::vector<double> values;
  for (double n = std::ceil((from - slack) / step); n * step <= to + slack; ++n)
    values.push_back(n == 0 ? 0 : n * step);  // not -0
  return values;
}

}  // namespace sim
