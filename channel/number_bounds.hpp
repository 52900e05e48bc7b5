#pragma once
// What is known of a part's number that no document prints: where it lies, and how likely.
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace channel {

enum class Distribution { uniform, log_uniform };

struct DistributionName {
  std::string_view name;  // as a part's file has it
  Distribution distribution;
};

std::span<const DistributionName> distributions();

std::string_view distribution_name(Distribution distribution);

/// The unit is that of the number.
struct NumberBounds {
  std::string number;  // its key in the part's file
  double low, high;
  Distribution distribution = Distribution::uniform;  // log-uniform: low is positive
  bool is_measured = false;                           // of this very unit, as its source says
  bool breaks_rule = false;                           // of a unit that the model does not describe
};
using AllBounds = std::vector<NumberBounds>;

/// The value below which that share of all parts lies, from 0 to 1.
double quantile(const NumberBounds& bounds, double share);

}  // namespace channel
