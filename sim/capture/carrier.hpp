#pragma once
// The carrier of a light, found in a stretch of it: the strongest narrow line of the spectrum from
// 20 kHz on. It counts where the 3 kHz around it, which hold a bit rate of some hundreds, have ten
// times the density of the 6 kHz on either side, and 0.3 % of all power but the mean's. A wire that
// was sampled has no such line unless it sends alternating bits at more than 40 kBd.
#include <optional>
#include <span>

#include "dsp/units.hpp"

namespace sim {

/// Nothing where there is none, or in fewer than 256 samples.
std::optional<dsp::Hertz> find_carrier(std::span<const float> samples, dsp::Hertz sample_rate);

}  // namespace sim
