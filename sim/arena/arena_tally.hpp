#pragma once
// What the runs of an arena count, device by device. All whole numbers: sums of them do not depend
// on the order.
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "dsp/units.hpp"
#include "sim/arena/loss_cause.hpp"
#include "sim/counting/statistics.hpp"

namespace sim {

/// How long it took until something was heard.
struct Latency {
  std::uint64_t n_runs_heard = 0;  // with a message delivered at least
  std::uint64_t sum_us = 0;        // over those, from time 0 to the first one's end
  std::uint64_t worst_us = 0;      // of them

  void add(dsp::Seconds first_end);
  double mean_s() const;   // NaN if nothing was ever heard
  double worst_s() const;  // NaN too
  Latency& operator+=(const Latency& other);
  template <class Archive>
  void serialize(Archive& archive) {
    archive(n_runs_heard, sum_us, worst_us);
  }
};

/// Messages of one device that start within a run.
struct SenderTally {
  std::array<std::uint64_t, loss_causes> by_cause{};
  std::uint64_t n_in_reach = 0;    // sent, less those out of reach
  std::uint64_t n_overlapped = 0;  // of those, with light of another device in reach
  std::uint64_t n_captured = 0;    // of those, delivered all the same
  std::uint64_t airtime_us = 0, airtime_in_reach_us = 0, airtime_delivered_us = 0;
  Latency latency;
  ClusterSums losses;  // lost of sent; its runs

  std::uint64_t operator[](LossCause f) const { return by_cause[static_cast<std::size_t>(f)]; }
  /// Those that the device had to send.
  std::uint64_t messages() const;
  std::uint64_t sent() const { return messages() - (*this)[LossCause::silent]; }
  std::uint64_t lost() const { return sent() - (*this)[LossCause::delivered]; }

  SenderTally& operator+=(const SenderTally& other);
  template <class Archive>
  void serialize(Archive& archive) {
    archive(by_cause, n_in_reach, n_overlapped, n_captured, airtime_us, airtime_in_reach_us,
            airtime_delivered_us, latency, losses);
  }
};

/// A message that was delivered.
struct HeardFrame {
  std::uint32_t run = 0, sender = 0;
  double start_s = 0, end_s = 0;
  double x_m = 0, y_m = 0;  // of the receiver at its end
  std::string message{};

  template <class Archive>
  void serialize(Archive& archive) {
    archive(run, sender, start_s, end_s, x_m, y_m, message);
  }
};

struct ArenaTally {
  std::vector<SenderTally> senders;
  std::uint64_t n_runs = 0;
  ClusterSums losses;         // of all devices together, by runs
  Latency any;                // until the first message of any of them
  std::uint64_t n_false = 0;  // frames accepted that nobody sent

  ArenaTally& operator+=(const ArenaTally& other);
  template <class Archive>
  void serialize(Archive& archive) {
    archive(senders, n_runs, losses, any, n_false);
  }
};

}  // namespace sim
