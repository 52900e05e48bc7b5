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

  bool reached() const { return arena.reached(); }
};

/// Sum over the devices of a point.
MirrorTally together(const GuardPoint& point);

/// All points of a scenario. Throws bad_input where messages cannot be a SharedLink list: devices
/// whose messages begin alike, characters that it cannot carry.
std::vector<GuardPoint> run_guards(const LoadedScenario& scenario, const Workers& workers = {},
                                   const OnPoint<GuardPoint>& on_point = {});

}  // namespace sim
