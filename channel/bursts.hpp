#pragma once
#include <vector>

#include "channel/keyed_carrier.hpp"
#include "dsp/logic_trace.hpp"
#include "dsp/units.hpp"

namespace channel {

/// Intervals of light on a drive wire, which is low in light, in samples.
std::vector<Burst> bursts_of(const dsp::LogicTrace& drive, dsp::Hertz sample_rate);

}  // namespace channel
