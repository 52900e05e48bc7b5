#include "sim/stop_rule.hpp"

#include "sim/statistics.hpp"

namespace sim {
namespace {

constexpr double usual_level = 0.95;
constexpr double sure_level = 0.999;

bool is_narrow(const Estimate& e, double relative) {
  return e.value > 0 && (e.high - e.low) / 2 <= relative * e.value;
}

bool is_told(const Estimate& e, double from) { return e.high < from || e.low > from; }

}  // namespace

std::optional<StopReason> stop_reason(const StopRule& rule, const Tally& counted) {
  if (rule.max_frame_errors > 0 && counted.n_frames_lost >= rule.max_frame_errors)
    return StopReason::max_frame_errors;
  if (rule.rel_ci > 0 && is_narrow(bit_error_ratio(counted, usual_level), rule.rel_ci))
    return StopReason::rel_ci;
  if (rule.target_flr > 0 && is_told(frame_loss_ratio(counted, sure_level), rule.target_flr))
    return StopReason::target_flr;
  if (counted.n_frames >= rule.max_frames) return StopReason::max_frames;
  return std::nullopt;
}

}  // namespace sim
