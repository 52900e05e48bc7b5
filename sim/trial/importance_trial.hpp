#pragma once
// Trials drawn by importance sampling, on the same chain as all others. Of a group of trials, those
// that noise is likelier to break are run, some of them more than once and others not at all; each
// run has noise that is drawn from its trial's proposal (sim/trial/proposal.hpp) where its bits are
// decided, and as it comes elsewhere. What it counts is weighted with the natural probability of
// all this over the one it was drawn with, so sums are without bias.
#include "sim/trial/trial.hpp"

namespace sim {

/// run_groups for such a link. The tally's own counts are those of the runs as drawn.
std::vector<GroupResult> run_weighted_groups(const Link& link, std::uint32_t first, int n,
                                             const std::atomic<bool>* stop, bool profiled);

}  // namespace sim
