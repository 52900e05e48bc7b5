#pragma once
// A search beyond the jumps that hold a fit. Least squares do not see a better minimum behind a
// jump. It lies on a way along which the cost hardly grows: the profile of a number, on which the
// others go with it.
#include <functional>
#include <vector>

#include "sim/fit/least_squares.hpp"

namespace sim {

/// Moves each of the numbers of `moved` up and down by standard deviations, all others with it as
/// the covariance has them go together, and fits anew from the best places that it sees. Does so
/// again from what is better, as long as something is, and `go_on` says yes.
Numbers profile_search(const LeastSquaresProblem& problem, const Numbers& x,
                       const std::vector<bool>& moved, const std::function<bool()>& go_on);

}  // namespace sim
