#pragma once
// What the trials of a point share where each bit is one decision variable (sim/scenario/fidelity).
#include <optional>

#include "channel/decision.hpp"
#include "dsp/units.hpp"
#include "sim/counting/tally.hpp"

namespace sim {

struct Link;

struct DecisionLink {
  channel::DecisionDesign bits;  // of all messages of a trial, one after the other
  dsp::Seconds trial;            // its mean length
  /// What a trial without a wrong bit counts. Nothing where the clocks of device and UART are so
  /// far apart that the UART may misread right bits: then all trials are decoded.
  std::optional<Tally> clean{};
};

/// Of a link that is complete but for this; `output`: what its matched receiver measures.
DecisionLink make_decision_link(const Link& link, const channel::CorrelatorOutput& output);

}  // namespace sim
