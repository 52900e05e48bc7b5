#include "sim/counting/stop_rule.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "sim/counting/statistics.hpp"

namespace sim {
namespace {

constexpr std::array reason_names{"max_frames", "max_frame_errors", "interrupted", "rel_ci",
                                  "target_flr"};

Side side_of(const Estimate& e, double level) {
  if (e.high < level) return Side::below;
  return e.low > level ? Side::above : Side::unknown;
}

bool is_narrow(const Estimate& e, double relative) {
  return e.value > 0 && (e.high - e.low) / 2 <= relative * e.value;
}

}  // namespace

std::span<const char* const> stop_reason_names() { return reason_names; }

const char* stop_reason_name(StopReason reason) {
  return reason_names.at(static_cast<std::size_t>(reason));
}

double worth_of_losses(const Tally& counted) {
  if (!counted.is_weighted()) return static_cast<double>(counted.n_frames_lost);
  const Weighted& weighted = counted.weighted;
  return std::min(weighted.bit_errors.effective_size(), weighted.frames_lost.effective_size());
}

Side side_of(const Tally& counted, double flr) {
  return side_of(frame_loss_ratio(counted, sure_level), flr);
}

StopFigures figures_of(const Tally& counted) {
  return {.ratio = [&](double level) { return bit_error_ratio(counted, level); },
          .loss = [&](double level) { return frame_loss_ratio(counted, level); },
          .losses = worth_of_losses(counted)};
}

bool looks_at_ratio(const StopRule& rule) { return rule.rel_ci > 0 || rule.target_flr > 0; }

std::optional<StopReason> stop_reason(const StopRule& rule, const StopFigures& counted) {
  if (rule.max_frame_errors > 0 && counted.losses >= static_cast<double>(rule.max_frame_errors))
    return StopReason::max_frame_errors;
  if (rule.rel_ci > 0 && is_narrow(counted.ratio(usual_level), rule.rel_ci))
    return StopReason::rel_ci;
  if (rule.target_flr > 0 && side_of(counted.loss(sure_level), rule.target_flr) != Side::unknown)
    return StopReason::target_flr;
  return std::nullopt;
}

std::uint32_t next_look(std::uint32_t done) {
  const std::uint32_t pause = std::max(8U, std::bit_floor(done / 16));
  return (done / pause + 1) * pause;
}

bool is_look(std::uint32_t done) { return done > 0 && next_look(done - 1) == done; }

}  // namespace sim
