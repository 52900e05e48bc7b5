#pragma once
// What makes a receiver module miss a bit, as a proposal for importance sampling. A lit bit is
// missed when so many peaks of the band-pass's output in a row stay below the comparator's level
// that the integrator runs empty. Each trial is run without noise first, which tells how far its
// peaks are above that level; with noise they are missed where readings exceed these margins.
#include <atomic>
#include <vector>

#include "sim/link.hpp"
#include "sim/trial_group.hpp"
#include "sim/trial_proposal.hpp"

namespace sim {

/// Of each trial of a group.
std::vector<TrialProposal> module_proposals(const Link& link, const TrialGroup& group,
                                            const std::atomic<bool>* stop,
                                            channel::StageClock* clock);

/// Carrier cycles in a row without a comparator's pulse that empty the integrator of a module, or
/// of the unit of its population that needs the fewest.
int missed_cycles(const channel::ModuleData& module, dsp::Hertz carrier, bool population);

}  // namespace sim
