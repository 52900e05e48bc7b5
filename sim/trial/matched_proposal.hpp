#pragma once
// What makes a matched receiver miss a bit, as a proposal for importance sampling: one reading of
// the noise a bit, against the carrier's phase where the bit is light and along it where it is
// dark; for the envelope, which has no phase, of a dark bit in several directions.
#include "sim/link/link.hpp"
#include "sim/trial/drawn_trials.hpp"
#include "sim/trial/trial_proposal.hpp"

namespace sim {

/// Of one trial, whose carrier has `phase` at time 0.
TrialProposal matched_proposal(const Link& link, const Transmission& sent, std::uint32_t phase);

}  // namespace sim
