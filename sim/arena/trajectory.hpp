#pragma once
// A receiver's way over the floor: from way-point to way-point at one speed, in straight lines.
// Where no headings are given it looks where it goes and turns on the spot at way-points; where
// they are, it turns evenly as it goes. It stays where the way ends.
#include <vector>

#include "dsp/units.hpp"
#include "sim/scenario/placed_device.hpp"

namespace sim {

struct Pose2D {
  double x = 0, y = 0;  // m
  dsp::Radians heading;
};

class Trajectory {
 public:
  /// Throws bad_input where the lists do not fit together.
  explicit Trajectory(const PathSettings& path);

  Pose2D at(dsp::Seconds t) const;
  /// Where it begins, turns and ends.
  std::vector<Pose2D> corners() const;
  dsp::Seconds duration() const { return legs_.empty() ? dsp::Seconds(0) : legs_.back().end; }
  /// m along the way until then; turning on the spot is none.
  double distance(dsp::Seconds t) const;

 private:
  /// Even motion from one place to another, or a turn.
  struct Leg {
    dsp::Seconds start, end;
    Pose2D from, to;
    double distance_before;
  };

  void go(const Pose2D& to, double speed_m_per_s);
  void turn(dsp::Radians heading, dsp::Radians per_second);
  void add(const Pose2D& to, dsp::Seconds time);
  const Leg* leg_at(dsp::Seconds t) const;

  Pose2D now_;  // where the legs so far lead
  std::vector<Leg> legs_;
};

}  // namespace sim
