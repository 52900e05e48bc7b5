#pragma once
// A point as a run leaves it, and axes of which one has texts, for the tests of what is reported of
// it.
#include "sim/result/result.hpp"

namespace sim {

inline LinkPoint measured_point() {
  LinkPoint p;
  p.coordinates = {7.5};
  p.operating = {0.312, 0.6, 14.25, 5000, 21.3};
  p.tally.n_frames = 1000;
  p.tally.n_frames_lost = 100;
  p.tally.n_bits = 170000;
  p.tally.n_bit_errors = 340;
  p.tally.n_frames_bit_errors = 100;
  p.tally.sum_bits_squared = 1000 * 170 * 170;
  p.tally.sum_bit_errors_squared = 1200;
  p.tally.sum_bit_errors_times_bits = 340 * 170;
  p.stop = StopReason::max_frame_errors;
  p.elapsed_s = 2;
  p.simulated_s = 620;
  return p;
}

inline const std::vector<Axis> text_axes{
    {"receiver.module", "", "receiver module", {0, 1}, {"TSOP4856", "a-longer-name"}},
    {"receiver.range_m", "m", "distance", {1, 2, 3}}};

}  // namespace sim
