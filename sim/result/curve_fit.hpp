#pragma once
// Where along a swept axis the frame loss crosses a level: a curve that may bend
// (sim/result/bending_curve.hpp) over the logarithm of the axis, or the axis itself if it is not
// positive. Where that does not fit the
// points, or has to guess the loss of so few frames, no more is said than what a rising loss allows
// (sim/result/isotonic.hpp). What is not known is an outcome of its own, never an exception.
#include "sim/result/result.hpp"

namespace sim {

struct Crossing {
  enum class Kind {
    fitted,        // at `at`, interval [low, high]
    jump,          // between the neighbours [low, high]: too steep for a fit (separation)
    bracketed,     // in the interval [low, high], of which one end may be infinite
    all_below,     // no crossing: at most the level at every point, from low to high
    all_above,     // no crossing: above the level at every point, from low to high
    unclear,       // points on both sides of the level, but not told apart
    not_monotone,  // the loss goes up and down beyond its intervals: no single crossing
    unfinished,  // all on one side from low to high (NaN: none), but beyond nothing is counted yet
  };
  Kind kind = Kind::unclear;
  /// `at` is the middle of the step that was seen, where nothing is fitted.
  double at = 0, low = 0, high = 0;
  /// Of all_below the largest upper end of the points' intervals, of all_above the least lower end;
  /// of a jump the upper end at the last point before it, which is at `bound_at`.
  double bound = 0, bound_at = 0;
};

/// For an experiment with exactly one axis; points never reached are left out, but where they lie
/// beyond those that were and could hold the crossing. Intervals are those of the result's
/// ci_level.
Crossing frame_loss_crossing(const LinkResult& result, double level = 0.01);

}  // namespace sim
