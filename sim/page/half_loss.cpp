#include "sim/page/half_loss.hpp"

#include <algorithm>
#include <cmath>

namespace sim {
namespace {

constexpr int doublings = 6;
constexpr int halvings = 5;  // of a factor of two: 2 % remain

double middle(double a, double b) { return std::sqrt(a * b); }

}  // namespace

HalfLoss find_half_loss(const LosesHalf& loses_half, const HalfLossSearch& search) {
  const bool loses = search.begin_loses;
  const double factor = loses == search.more_is_better ? 2 : 0.5;
  double same = search.begin, other = same;  // on either side of what is looked for
  for (int i = 0; other == same; ++i) {
    const double next = std::clamp(same * factor, search.allowed.low, search.allowed.high);
    const bool is_allowed = i < doublings && next != same && search.allowed.contains(next);
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
