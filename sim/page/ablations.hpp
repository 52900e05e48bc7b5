#pragma once
// What limits a link, asked of the link itself: the point where it fails is run again, each
// time without one of the things that trouble it.
#include <optional>
#include <string>
#include <vector>

#include "sim/counting/tally.hpp"
#include "sim/page/half_loss.hpp"
#include "sim/result/result.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/threads/parallel_runs.hpp"

namespace sim {

struct Ablation {
  std::string change;  // "without noise"; empty: the link as it is
  Tally tally;
  std::optional<HalfLoss> half{};  // along Ablations::along, unless that is what is left out
};

struct Ablations {
  std::string place;                // "receiver.range_m = 2.2 m"; empty of a single point
  std::vector<Ablation> ablations;  // first the link as it is
  std::optional<Axis> along{};      // of the ranking, where the loss goes one way and has a half
};

/// Where the link fails, of several that are compared the one that comes first: the point that
/// loses the least of those that lose half their frames, or else the one that loses the most. Null
/// where no frame is lost.
const LinkPoint* failing_point(const LinkResult& result);

/// At the failing point, with 100 frames each, or fewer where a trial has more than 2e6 samples, 20
/// at least; and, where it has at most 4e6, how far each goes before half of 20 frames are lost.
/// Empty where there is none, of ideal receivers, which noise alone troubles, and of weighted
/// trials. Without what the scenario's other keys need, as an envelope a threshold far above noise.
/// Worth nothing after an interrupt.
Ablations ablate(const LoadedScenario& scenario, const LinkResult& result, const Workers& workers);

/// The changes with which the loss is clearly less, at 95 %. What carries farthest comes first, as
/// far as that is known.
std::vector<Ablation> limits_of(const Ablations& ablations);

/// "21", "beyond 64", "short of 0.1": a third digit is more than some tens of frames tell.
std::string half_loss_text(const HalfLoss& half);

}  // namespace sim
