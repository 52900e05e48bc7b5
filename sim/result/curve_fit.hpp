#pragma once
// Where along a swept axis the frame loss crosses a level: binomial regression (logit link) against
// the logarithm of the axis, or the axis itself if it is not positive. What cannot be fitted is an
// outcome with its reason, never an exception.
#include <string>
#include <vector>

#include "sim/result/result.hpp"

namespace sim {

struct Crossing {
  enum class Kind {
    fitted,        // at `at`, interval [low, high]
    jump,          // between the neighbours [low, high]: too steep for a fit (separation)
    unfitted,      // somewhere in [low, high]: the fit did not converge or contradicts a point
    all_below,     // no crossing: at most the level at every point, from low to high
    all_above,     // no crossing: above the level at every point, from low to high
    unclear,       // points on both sides of the level, but not told apart
    not_monotone,  // the loss goes up and down beyond its intervals: no single crossing
  };
  Kind kind = Kind::unclear;
  double at = 0, low = 0, high = 0;
  /// Of all_below the largest upper end of the points' intervals, of all_above the least lower end;
  /// of a jump the upper end at the last point before it.
  double bound = 0;
};

/// For an experiment with exactly one axis; points never reached are left out.
Crossing frame_loss_crossing(const ExperimentResult& result, double level = 0.01);

/// "frame loss crosses 1 % at receiver.range_m = 7.9 [7.6, 8.2] m"
std::string crossing_sentence(const Axis& axis, const Crossing& crossing, double level = 0.01);

/// The same in few words, for a list whose head says the rest: "7.9 [7.6, 8.2] m".
std::string crossing_words(const Axis& axis, const Crossing& crossing, double level = 0.01);

/// "receiver.range_m = 7 m": a value of an axis with its unit, if it has one.
std::string quantity(const Axis& axis, const std::string& value);

/// "receiver.range_m = 2.2 m, receiver.module = TSOP4856": a point of a sweep; empty where nothing
/// was swept.
std::string place_text(const std::vector<Axis>& axes, const std::vector<double>& coordinates);

}  // namespace sim
