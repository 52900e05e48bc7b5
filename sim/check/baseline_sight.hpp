#pragma once
// What a check of a baseline will see, in words: how much worse a decoder must be to be found, and
// whether so many frames let an equal one pass.
#include <cstdint>
#include <optional>
#include <string>

#include "sim/check/baseline.hpp"
#include "sim/check/sequential_test.hpp"

namespace sim {

/// Of a point's frames, those that the baseline's decoder lost.
std::uint64_t lost_frames(const BaselinePoint& point);

class BaselineSight {
 public:
  /// Of a baseline of so many points, for checks that find what they shall with probability
  /// `power`: a decoder that loses `detect` times as much, if that is asked for.
  BaselineSight(std::optional<double> detect, double power, std::size_t points);

  /// How many frames the point is to have for that, 100,000 at most; 0: those that it has.
  std::uint64_t frames_for(const BaselinePoint& point) const;

  /// "; a check finds 1.3 times as many"
  std::string of_point(const BaselinePoint& point);
  /// A line, behind all points.
  std::string of_all() const;

 private:
  std::string found_at(const BaselinePoint& point) const;
  std::string passes_at(const BaselinePoint& point);

  SequentialTestRule rule_;
  bool detects_;
  double power_;
  std::size_t points_, in_doubt_ = 0;
};

}  // namespace sim
