#pragma once
// What the runs of a robo-guard count, device by device, behind what its arena counts.
#include <cstdint>
#include <vector>

#include "sim/counting/age_counts.hpp"

namespace sim {

/// Messages of one device that the guard has heard, and what the base station knows of it.
struct RelayTally {
  std::uint64_t n_replaced = 0;  // by a newer one of the device, before it was passed on
  std::uint64_t n_lost = 0;      // on the line
  std::uint64_t n_known = 0;     // at the base station
  AgeCounts age;                 // of what the base station knows, from the message's start

  RelayTally& operator+=(const RelayTally& other);
  template <class Archive>
  void serialize(Archive& archive) {
    archive(n_replaced, n_lost, n_known, age);
  }
};

/// Of a run or more, besides what their arena counts.
struct GuardTally {
  std::vector<RelayTally> relays;                              // one a device
  std::uint64_t n_sent = 0, n_accepted = 0;                    // SharedLink messages, both ways
  std::uint64_t n_asked = 0, n_answered = 0, n_timed_out = 0;  // questions of the base station

  GuardTally& operator+=(const GuardTally& other);
  template <class Archive>
  void serialize(Archive& archive) {
    archive(relays, n_sent, n_accepted, n_asked, n_answered, n_timed_out);
  }
};

}  // namespace sim
