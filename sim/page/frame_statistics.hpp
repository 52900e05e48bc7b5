#pragma once
// Where the frames of one point go wrong: the trials that were counted there are run again, and
// their pins compared with what was sent, bit by bit and edge by edge.
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/counting/shard.hpp"
#include "sim/counting/statistics.hpp"
#include "sim/link/link.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/threads/parallel_runs.hpp"
#include "sim/trace/trace.hpp"

namespace sim {

/// How much later than the light's the edges of the pin are, in microseconds.
struct EdgeDelays {
  std::vector<double> falling_us, rising_us;  // light begins, light ends
  std::size_t missing = 0;                    // edges of the light that the pin lacks
};

/// Where bits of the last message are wrong at the pin, in the middle of their slots. Messages of a
/// scenario are all the same.
struct WrongBits {
  std::vector<std::string> characters;      // as sent
  std::vector<std::array<int, 10>> counts;  // of each, by the slot: start bit, 0 to 7, stop bit
  std::vector<ClusterSums> shares;          // of each character, of its ten bits
  std::vector<int> bursts;                  // [n]: how often n + 1 followed each other
};

struct FrameStatistics {
  int trials = 0;          // looked at
  bool are_all = false;    // of those that were counted
  double character_s = 0;  // the time that a character takes
  EdgeDelays delays{};
  WrongBits wrong{};
  std::optional<std::uint32_t> first_misread{};  // number of the trial
};

/// How many trials of a link have no more than about so many samples together; 20 at least.
std::uint64_t affordable_trials(const Link& link, double most_samples);

/// Of the `counted` trials of the point that `scenario` is: all of them, but no more than the first
/// 400, nor more than about 1e9 samples, and 20 at least. Worth nothing after an interrupt.
FrameStatistics look_at_frames(const Scenario& scenario, const TrialRange& counted,
                               const Workers& workers);

/// Adds those of a trial's last message. An edge is missing that the pin does not have within half
/// a bit of where the module's nominal delay puts it.
void add_delays(EdgeDelays& delays, const TracedTrial& trial);

void add_wrong_bits(WrongBits& wrong, const TracedTrial& trial);

}  // namespace sim
