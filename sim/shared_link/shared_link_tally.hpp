#pragma once
// What two nodes told each other in runs of an exchange: in integers, so that the order of adding
// changes nothing.
#include <array>
#include <cstdint>
#include <vector>

#include "protocol/shared_link.hpp"
#include "sim/counting/age_counts.hpp"
#include "sim/counting/statistics.hpp"

namespace sim {

/// How many, by SharedLinkOutcome.
using SharedLinkReasons = std::array<std::uint64_t, protocol::shared_link_outcomes>;

/// One direction, named by its sender; of a run or more.
struct DirectionTally {
  std::uint64_t n_sent = 0, n_accepted = 0;  // messages
  std::uint64_t n_bits = 0, n_bit_errors = 0;
  std::uint64_t n_asked = 0, n_answered = 0, n_timed_out = 0;  // questions of the sender
  std::uint64_t n_own = 0;          // messages of its own that the sender heard
  SharedLinkReasons own_damaged{};  // those of its own that its decoder refused
  SharedLinkReasons rejected{};     // lines that the receiver refused and were not its own
  ClusterSums losses{};             // of messages, runs as clusters
  // Of each of its variables at the receiver, since the turn that brought the value.
  std::vector<AgeCounts> variable_ages{};

  /// Of all variables.
  AgeCounts age() const;
  DirectionTally& operator+=(const DirectionTally& other);

  template <class Archive>
  void serialize(Archive& archive) {
    archive(n_sent, n_accepted, n_bits, n_bit_errors, n_asked, n_answered, n_timed_out, n_own,
            own_damaged, rejected, losses, variable_ages);
  }
};

struct SharedLinkTally {
  std::array<DirectionTally, 2> direction;  // A to B, B to A
  ClusterSums losses{};                     // of both: what collides is lost together
  std::uint64_t n_runs = 0;

  SharedLinkTally& operator+=(const SharedLinkTally& other);
  template <class Archive>
  void serialize(Archive& archive) {
    archive(direction, losses, n_runs);
  }
};

/// Both directions together.
DirectionTally together(const SharedLinkTally& tally);

/// Messages not accepted over messages sent, with its interval (95 %), runs being clusters.
Estimate message_loss(const DirectionTally& tally);
/// NaN where nothing was sent.
double bit_error_ratio(const DirectionTally& tally);

}  // namespace sim
