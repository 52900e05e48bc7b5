#pragma once
// What makes a receiver module miss a bit, as a proposal for importance sampling. A lit bit is
// missed when so many peaks of the band-pass's output in a row stay below the comparator's level
// that the integrator runs empty. Each trial is run without noise first, which tells how far its
// peaks are above that level; with noise they are missed where readings exceed these margins.
#include <atomic>
#include <vector>

#include "sim/link/link.hpp"
#include "sim/trial/drawn_trials.hpp"
#include "sim/trial/trial_proposal.hpp"

namespace sim {

/// Of each of these trials.
std::vector<TrialProposal> module_proposals(const Link& link, const DrawnTrials& drawn,
                                            const std::atomic<bool>* stop,
                                            channel::StageClock* clock);

}  // namespace sim
