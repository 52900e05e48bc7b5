#pragma once
// How the noise of one trial is drawn by importance sampling.
#include <memory>
#include <vector>

#include "sim/trial/proposal.hpp"

namespace sim {

/// A trial's noise to be drawn, and how.
struct TrialProposal {
  std::vector<Stretch> stretches;
  Proposal proposal;
  std::shared_ptr<const void> owner{};  // of what the proposal's readings refer to
  /// About how probable it is that noise makes light of a dark bit, which is not drawn.
  double dark_likelihood = 0;
};

}  // namespace sim
