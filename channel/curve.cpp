#include "channel/curve.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace channel {

double Curve::operator()(double at) const {
  assert(!empty() && x.size() == y.size());
  const auto above = std::upper_bound(x.begin(), x.end(), at);
  if (above == x.begin()) return y.front();
  if (above == x.end()) return y.back();
  const auto i = static_cast<std::size_t>(above - x.begin());
  return std::lerp(y[i - 1], y[i], (at - x[i - 1]) / (x[i] - x[i - 1]));
}

}  // namespace channel
