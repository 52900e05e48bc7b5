#pragma once
// A robo-guard at all points of its scenario's sweep: an arena, and how what is heard in it gets to
// the base station.
#include <vector>

#include "sim/arena/arena_experiment.hpp"
#include "sim/guard/guard_tally.hpp"
#include "sim/guard/relay.hpp"

namespace sim {

struct GuardPoint : ArenaPoint {
  std::vector<std::string> variables{};  // of each device
  GuardTally relayed{};
};

/// Sum over the devices of a point.
RelayTally relayed_together(const GuardPoint& point);

/// A point ready for its runs.
struct Guard {
  Arena arena;
  RelayDesign design;
};

struct GuardRuns {
  ArenaRuns arena;
  GuardTally tally;

  /// Adds the runs behind these.
  GuardRuns& operator+=(const GuardRuns& next);
  template <class Archive>
  void serialize(Archive& archive) {
    archive(arena, tally);
  }
};

/// Preparing throws bad_input where messages cannot be a SharedLink list: devices whose messages
/// begin alike, characters that it cannot carry.
extern const Measurement<Guard, GuardRuns, GuardPoint> guard_measurement;

}  // namespace sim
