#pragma once
// A stop rule at work on counts of a test's own, and trials that are gone on with.
#include <functional>
#include <optional>

#include "sim/counting/stop_rule.hpp"
#include "sim/engine/counted_runs.hpp"
#include "sim/link_experiment/link_measurement.hpp"

namespace sim {

/// Why a point of a link is finished with these counts; nothing while it is not.
inline std::optional<StopReason> stop_reason(const StopRule& rule, const Tally& counted) {
  if (const auto reason = stop_reason(rule, figures_of(counted))) return reason;
  if (counted.n_frames >= rule.max_frames) return StopReason::max_frames;
  return std::nullopt;
}

/// The same where the ratio is the loss.
inline std::optional<StopReason> stop_reason(const StopRule& rule,
                                             const std::function<Estimate(double level)>& ratio) {
  return stop_reason(rule, StopFigures{ratio, ratio});
}

/// Adds the trials to `part` that it does not have yet, as an interrupt left it.
inline void go_on(CountedRuns<LinkTally>& part, const Link& link, const StopRule& rule,
                  const Workers& workers, const std::function<void()>& meanwhile = {}) {
  RunClock clock;
  const LinkSetup setup{link};
  const AskedRuns asked{.all = static_cast<std::uint32_t>(rule.max_frames), .rule = rule};
  PointCounting(link_measurement, setup, asked, clock).add_to(part, {workers}, meanwhile);
}

}  // namespace sim
