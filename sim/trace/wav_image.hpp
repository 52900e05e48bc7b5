#pragma once
// A WAV file of one channel in memory: equal samples give equal bytes. The rate is rounded to whole
// hertz, as WAV has no others.
#include <span>
#include <string>

#include "dsp/units.hpp"

namespace sim {

/// What is said in it; nothing of what is empty.
struct WavWords {
  std::string software, comment;
};

/// The whole file, of floats or of 16 bits a sample. Throws Failure(environment) for more than
/// 4 GiB.
std::string wav_image(std::span<const float> samples, dsp::Hertz rate, const WavWords& words);
std::string wav_image(std::span<const short> samples, dsp::Hertz rate);

}  // namespace sim
