#include "sim/result/point_loss.hpp"

#include "sim/counting/stopped_loss.hpp"

namespace sim {

bool may_stop_by_target(const LinkPoint& point) { return point.rule.target_flr > 0; }

Estimate frame_loss_of(const LinkPoint& point, double level) {
  if (!may_stop_by_target(point) || !point.reached()) return frame_loss_ratio(point.tally, level);
  return stopped_loss(point.rule, point.tally.n_frames, point.tally.n_frames_lost, level);
}

}  // namespace sim
