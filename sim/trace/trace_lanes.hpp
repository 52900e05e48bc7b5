#pragma once
// What a picture of a trial draws over one time axis, one lane below the other, above the pin: its
// light, and what the receiver makes of it.
#include <string>
#include <vector>

#include "sim/picture/waveform.hpp"
#include "sim/trace/trace.hpp"

namespace sim {

struct LaneCurve {
  SampledWave wave;
  const char* style;  // a class of the style sheet
};

struct Lane {
  std::vector<std::string> names;  // beside it, one below the other
  double least = 0, greatest = 1;  // what it reaches over; greatest > least
  bool is_measured = true;         // its values are worth marks
  std::vector<LaneCurve> curves{};
};

/// Light as it was keyed, eight values to a cycle of the carrier; empty where it was sampled.
std::vector<float> keyed_light(const TracedTrial& trial);

/// Of the samples, or else of `keyed`, which is keyed_light.
Lane light_lane(const TracedTrial& trial, const std::vector<float>& keyed);

/// Those taps behind the light that were recorded, in the order of the signal's way; the threshold
/// over what it is compared with.
std::vector<Lane> tap_lanes(const TracedTrial& trial);

}  // namespace sim
