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

/// From a value above 0, which can be simulated, up to 64 times as far in the direction in which
/// the loss changes, as far as the key's range allows. `loses_half` is asked a dozen times.
HalfLoss find_half_loss(const LosesHalf& loses_half, double begin, const Range& allowed,
                        bool more_is_better);

}  // namespace sim
