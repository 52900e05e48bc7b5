#pragma once
// Rows of a picture over a sweep: one a point, or where there are too many points one for each
// value of the longest axis.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/scenario/axis.hpp"

namespace sim {

class SweptRows {
 public:
  explicit SweptRows(const std::vector<Axis>& axes);

  /// What the rows' labels are: "receiver.module, receiver.range_m [m]".
  std::string head() const;
  /// The row of a point: "TSOP4856, 2.5".
  std::string label(const std::vector<double>& coordinates) const;
  /// Whether a row has more than one point.
  bool joins_points() const { return over_.size() < axes_.size(); }
  /// Counts of a point as they are added to its row: where a row has several points, which may be
  /// of more or fewer counts, as thousandths of the point's, so that all weigh the same.
  std::vector<std::uint64_t> weighed(std::vector<std::uint64_t> counts) const;

 private:
  std::vector<Axis> axes_;
  std::vector<std::size_t> over_;
};

}  // namespace sim
