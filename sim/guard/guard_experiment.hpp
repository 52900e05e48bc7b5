#pragma once
// A robo-guard at all points of its scenario's sweep: an arena, and how what is heard in it gets to
// the base station.
#include <vector>

#include "sim/arena/arena_experiment.hpp"
#include "sim/guard/guard_tally.hpp"

namespace sim {

struct GuardPoint {
  ArenaPoint arena;                      // with its tally
  std::vector<std::string> variables{};  // of each device
  GuardTally tally{};                    // but for the arena's
};

/// Sum over the devices of a point.
MirrorTally together(const GuardPoint& point);

struct GuardOptions {
  int threads = 1;
  const std::atomic<bool>* interrupt = nullptr;
  std::function<void(const GuardPoint&)> on_point{};  // after each
};

/// All points; those never reached after an interrupt have no runs. Throws bad_input where messages
/// cannot be a SharedLink list: devices whose messages begin alike, characters that it cannot
/// carry.
std::vector<GuardPoint> run_guards(const LoadedScenario& scenario, const GuardOptions& options);

}  // namespace sim
