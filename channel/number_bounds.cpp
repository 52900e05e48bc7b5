#include "channel/number_bounds.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace channel {

std::span<const DistributionName> distributions() {
  static constexpr std::array<DistributionName, 2> table{
      {{"uniform", Distribution::uniform}, {"log-uniform", Distribution::log_uniform}}};
  return table;
}

std::string_view distribution_name(Distribution distribution) {
  return std::ranges::find(distributions(), distribution, &DistributionName::distribution)->name;
}

double quantile(const NumberBounds& bounds, double share) {
  if (bounds.distribution == Distribution::log_uniform)
    return bounds.low * std::pow(bounds.high / bounds.low, share);
  return bounds.low + share * (bounds.high - bounds.low);
}

}  // namespace channel
