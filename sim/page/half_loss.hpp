#pragma once
// Where along one number half the frames are lost: steep as most links fail, a few frames a value
// tell it.
#include <functional>
#include <optional>

#include "sim/scenario/keys.hpp"

namespace sim {

struct HalfLoss {
  enum class Kind { between, not_yet, already };
  Kind kind = Kind::between;
  /// The middle of two neighbours, 2 % apart; of not_yet the best value tried, at which fewer are
  /// lost, of already the worst, at which more are lost.
  double at = 0;
};

/// Nothing: no such value can be simulated.
using LosesHalf = std::function<std::optional<bool>(double)>;

/// Where to begin: a value above 0, and whether half is lost there.
struct HalfLossSearch {
  double begin = 0;
  bool begin_loses = false;
  Range allowed;
  bool more_is_better = false;
};

/// Up to 64 times as far as the beginning in the direction in which the loss changes, as far as the
/// key's range allows. `loses_half` is asked at most eleven times.
HalfLoss find_half_loss(const LosesHalf& loses_half, const HalfLossSearch& search);

}  // namespace sim
