#pragma once
// Least squares begun anew, again and again, around the best so far: jumps of the output hold it in
// many places, most of them poor. Basin hopping (Wales & Doye, J. Phys. Chem. A 101 (1997) 5111)
// that takes only what is better.
#include <functional>
#include <vector>

#include "sim/fit/least_squares.hpp"

namespace sim {

/// The best of all starts, or `x`. Starts are drawn by the covariance of the numbers that are
/// `drawn`, all others as they are; then all free ones move. The same draws each time. `go_on` is
/// asked before each start, with how many there were.
Numbers restarted_search(const LeastSquaresProblem& problem, const Numbers& x,
                         const std::vector<bool>& drawn, const std::function<bool(int)>& go_on);

}  // namespace sim
