#pragma once
// What a chart's axis covers: values, or their decimal logarithms, from the least to the greatest.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "sim/picture/chart.hpp"

namespace sim {

class AxisSpan {
 public:
  static constexpr double slack = 1e-9;  // of an exponent that was computed

  explicit AxisSpan(const ChartAxis& axis)
      : logarithmic_(axis.logarithmic), is_count_(axis.is_count) {}

  bool is_logarithmic() const { return logarithmic_; }
  /// Whether a value has a place on the axis.
  bool shows(double value) const { return std::isfinite(value) && (!logarithmic_ || value > 0); }
  void cover(double value) {
    if (!shows(value)) return;
    least_ = std::min(least_, value);
    greatest_ = std::max(greatest_, value);
  }
  /// The level, and a little on both sides, so that its line is not on the edge.
  void cover_level(const ChartAxis& axis) {
    if (!axis.level) return;
    cover(*axis.level / 2);
    cover(*axis.level * 2);
  }
  /// Infinite, and the greater first, where nothing was covered.
  double least() const { return least_; }
  double greatest() const { return greatest_; }
  bool is_count() const { return is_count_; }
  /// Of a logarithmic axis that covers something: the exponents of the powers of ten about it, of
  /// which there are two at least.
  double upper_exponent() const { return std::ceil(on_axis(greatest_) - slack); }
  double lower_exponent() const {
    return std::min(std::floor(on_axis(least_) + slack), upper_exponent() - 1);
  }
  /// What stands at a mark: "1e-3" of a power of ten far from 1.
  std::string label(double value) const;
  double on_axis(double value) const { return logarithmic_ ? std::log10(value) : value; }

 private:
  bool logarithmic_, is_count_;
  double least_ = std::numeric_limits<double>::infinity();
  double greatest_ = -std::numeric_limits<double>::infinity();
};

}  // namespace sim
