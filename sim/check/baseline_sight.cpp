#include "sim/check/baseline_sight.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/check/decoded_frames.hpp"
#include "sim/check/detectable_loss.hpp"

namespace sim {
namespace {

PointLosses losses_of(const BaselinePoint& point, std::size_t points) {
  return {.lost = lost_frames(point), .frames = point.frames.size(), .points = points};
}

}  // namespace

std::uint64_t lost_frames(const BaselinePoint& point) {
  return static_cast<std::uint64_t>(std::ranges::count_if(
      point.frames, [](const FrameRecord& frame) { return frame.outcome.lost(); }));
}

BaselineSight::BaselineSight(std::optional<double> detect, double power, std::size_t points)
    : rule_(rule_of_checks), detects_(detect.has_value()), power_(power), points_(points) {
  if (detect) rule_.worse_than = *detect;
}

std::uint64_t BaselineSight::frames_for(const BaselinePoint& point) const {
  constexpr std::uint64_t most = 100'000;
  if (!detects_) return 0;
  const std::uint64_t needed = frames_to_detect(rule_, losses_of(point, points_), power_);
  const std::uint64_t captures = (needed + frames_per_capture - 1) / frames_per_capture;
  return std::min(captures * frames_per_capture, most);
}

std::string BaselineSight::of_point(const BaselinePoint& point) {
  return "; a check finds " + found_at(point) + passes_at(point);
}

std::string BaselineSight::found_at(const BaselinePoint& point) const {
  const PointLosses losses = losses_of(point, points_);
  if (losses.lost == losses.frames) return "nothing, as all is lost";
  const double found = detectable_loss(rule_, losses, power_);
  if (std::isnan(found)) return "nothing, of so few frames";
  if (losses.lost == 0) return fmt::format("a loss of {:.2g} %", 100 * found);
  return fmt::format("{:.3g} times as many", found / losses.flr());
}

std::string BaselineSight::passes_at(const BaselinePoint& point) {
  const PointLosses losses = losses_of(point, points_);
  const double passes = passes_if_equal(rule_, losses);
  if (passes >= power_ || losses.lost == losses.frames) return "";
  ++in_doubt_;
  return fmt::format(", and passes an equal decoder in {:.2g} % or more", 100 * passes);
}

std::string BaselineSight::of_all() const {
  std::string text = fmt::format("found: in {:g} % of checks", 100 * power_);
  if (rule_.worse_than != rule_of_checks.worse_than)
    text += fmt::format(" with --worse-than {:g}", rule_.worse_than);
  text += "\n";
  if (in_doubt_ > 0 && !detects_)
    text += fmt::format(
        "{} of {} points may leave an equal decoder inconclusive: --detect {:g}x plays as many "
        "frames as it takes\n",
        in_doubt_, points_, rule_.worse_than);
  return text;
}

}  // namespace sim
