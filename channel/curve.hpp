#pragma once
// Curve: a tabulated characteristic of a part (a digitised data-sheet figure), linear between its
// points and constant beyond its ends. Abscissae must increase strictly; one point is a constant.
#include <vector>

namespace channel {

struct Curve {
  std::vector<double> x;
  std::vector<double> y;

  bool empty() const { return x.empty(); }
  /// The value at `at`; the curve must not be empty.
  double operator()(double at) const;
};

}  // namespace channel
