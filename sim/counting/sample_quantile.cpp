#include "sim/counting/sample_quantile.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>

namespace sim {

double sample_quantile(std::vector<double> values, double share) {
  assert(share >= 0 && share <= 1);
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double place = share * static_cast<double>(values.size() - 1);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(place);
  std::ranges::nth_element(values, at);
  const auto next = std::min_element(at + 1, values.end());
  return next == values.end() ? *at : std::lerp(*at, *next, place - std::floor(place));
}

}  // namespace sim
