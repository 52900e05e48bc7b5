#include "sim/page/half_loss.hpp"

#include <algorithm>
#include <cmath>

namespace sim {
namespace {

constexpr int doublings = 6;
constexpr int halvings = 5;  // of a factor of two: 2 % remain

double middle(double a, double b) { return std::sqrt(a * b); }

}  // namespace

HalfLoss find_half_loss(const LosesHalf& loses_half, double begin, const Range& allowed,
                        bool more_is_better) {
  const bool loses = loses_half(begin).value();
  const double factor = loses == more_is_better ? 2 : 0.5;
  double same = begin, other = begin;  // on either side of what is looked for
  for (int i = 0; other == same; ++i) {
    const double next = std::clamp(same * factor, allowed.low, allowed.high);
    const bool is_allowed = i < doublings && next != same && allowed.contains(next);
    const std::optional<bool> lost = is_allowed ? loses_half(next) : std::nullopt;
    if (!lost) return {loses ? HalfLoss::Kind::already : HalfLoss::Kind::not_yet, same};
    other = next;
    if (*lost == loses) same = next;
  }
  for (int i = 0; i < halvings; ++i) {
    const double between = middle(same, other);
    (loses_half(between) == loses ? same : other) = between;
  }
  return {HalfLoss::Kind::between, middle(same, other)};
}

}  // namespace sim
