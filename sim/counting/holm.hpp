#pragma once
#include <vector>

namespace sim {

/// Which of several hypotheses are rejected, of their p values, where the probability that any true
/// one is rejected is `alpha` at most (Holm, Scand. J. Statist. 6 (1979) 65-70): from the smallest
/// p on, as long as it is at most alpha over the number of those that are left.
std::vector<bool> rejected_by_holm(const std::vector<double>& p_values, double alpha);

}  // namespace sim
