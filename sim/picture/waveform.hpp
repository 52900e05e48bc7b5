#pragma once
// Waveforms as the "d" of an SVG path. What has more samples than the picture has columns is drawn
// by the least and the greatest of each column, so that no spike is lost.
#include <span>
#include <string>

#include "dsp/logic_trace.hpp"
#include "sim/picture/scale.hpp"

namespace sim {

/// A wire within the window [x.from, x.to] (seconds), between the values 0 and 1 of `y`.
std::string wire_path(const dsp::LogicTrace& wire, const Scale& x, const Scale& y);

/// Samples at equal distances: sample i at first_s + i * period_s.
struct SampledWave {
  std::span<const float> samples;
  double first_s = 0, period_s = 1;
};
/// The part within the window; empty without any sample in it.
std::string sampled_path(const SampledWave& wave, const Scale& x, const Scale& y);

}  // namespace sim
