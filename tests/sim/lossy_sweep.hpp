#pragma once
// Sweeps over the distance that lose what a test says, for the tests of what is said of them.
#include <string>
#include <utility>
#include <vector>

#include "sim/page/link_section.hpp"
#include "sim/result/result.hpp"

namespace sim {

inline LinkPoint point_of(double x, std::uint64_t frames, std::uint64_t lost) {
  LinkPoint point{.coordinates = {x}};
  point.operating.snr_db = 30 - x;
  point.tally.n_frames = frames;
  point.tally.n_frames_lost = point.tally.n_frames_unheard = lost;
  point.tally.n_frames_ok = frames - lost;
  point.tally.n_bits = 170 * frames;
  point.tally.sum_bits_squared = 170 * 170 * frames;
  return point;
}

inline LinkResult sweep_of(std::vector<LinkPoint> points) {
  LinkResult result;
  result.title = "Title";
  result.scenario_toml = "text";
  result.command = "command";
  Axis axis{"receiver.range_m", "m", "range", {}};
  for (const LinkPoint& point : points) axis.values.push_back(point.coordinates[0]);
  result.axes = {axis};
  result.points = std::move(points);
  return result;
}

/// What a result brings to a report, without a doubt of its ranges.
inline LinkReport link_report_of(std::string name, LinkResult result, Ablations ablations = {}) {
  Ranking ranking = rank(result);
  return {std::move(name), std::move(result), std::move(ranking), std::move(ablations)};
}

}  // namespace sim
