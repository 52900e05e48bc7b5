#pragma once
// What the trials of a point share where the envelope is computed in place of samples
// (sim/scenario/fidelity).
#include <cstdint>
#include <optional>
#include <vector>

#include "channel/envelope.hpp"
#include "dsp/units.hpp"

namespace sim {

struct Link;

struct EnvelopeLink {
  channel::EnvelopeChain chain;
  /// A stretch of each message and of the dark before it, in which the module's gain settles.
  struct Stretch {
    dsp::Seconds before;  // its message's first byte
    std::int32_t steps;
  };
  /// Empty where pauses are too short for that: then all of a trial is one stretch.
  std::vector<Stretch> stretches{};
};

/// Steps of the longest stretch that a trial may have, of a link that knows its device.
double longest_stretch(const Link& link, const channel::EnvelopeChain& chain);

/// Of a link that is complete but for this, and whose stretches' steps an int32_t holds.
EnvelopeLink make_envelope_link(const Link& link, const channel::LightSettings& light);

}  // namespace sim
