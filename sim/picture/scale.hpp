#pragma once
// From values to places on a picture, and the round values worth a mark between two others.
#include <vector>

namespace sim {

/// `from` stands at `at_from`, `to` at `at_to`; the values differ.
struct Scale {
  double from = 0, to = 1;
  double at_from = 0, at_to = 1;

  double operator()(double value) const {
    return at_from + (value - from) / (to - from) * (at_to - at_from);
  }
  /// The value that stands there.
  double value_at(double place) const {
    return from + (place - at_from) / (at_to - at_from) * (to - from);
  }
};

/// Multiples of 1, 2 or 5 times a power of ten within [from, to], at most `most` (>= 2) of them.
std::vector<double> round_values(double from, double to, int most);

}  // namespace sim
