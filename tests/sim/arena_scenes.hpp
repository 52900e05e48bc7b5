#pragma once
// Arenas for tests, from text: TSSP4056, which has no slow AGC, unless a test says otherwise.
#include <string>
#include <vector>

#include "counted_points.hpp"
#include "scenarios.hpp"
#include "sim/arena/arena.hpp"
#include "sim/arena/arena_experiment.hpp"
#include "sim/arena/arena_report.hpp"
#include "sim/command/experiments.hpp"
#include "sim/scenario/experiment_kind.hpp"

namespace sim {

inline const std::string arena_head = "experiment = \"arena\"\n[receiver]\nmodule = \"TSSP4056\"\n";

/// What the program makes of such a scenario: checked.
inline LoadedScenario loaded_arena(const std::string& text,
                                   const std::vector<std::string>& set = {}) {
  LoadedScenario scenario = loaded(arena_head + text, set);
  check_experiment(scenario);
  return scenario;
}

inline Arena arena_of(const std::string& text, const std::vector<std::string>& set = {}) {
  return make_arena(point_scenario(loaded_arena(text, set), {}));
}

/// The only point of a scenario.
inline ArenaPoint arena_point(const std::string& text, const std::vector<std::string>& set = {},
                              int threads = 2) {
  return counted_points(arena_measurement, loaded_arena(text, set), {.threads = threads}).front();
}

/// A device that looks at a receiver at the origin, `metres` away along x.
inline std::string device(const std::string& name, const std::string& metres,
                          const std::string& more = "") {
  return "[devices." + name + "]\nx_m = " + metres + "\nyaw_deg = 180\n" + more + "\n";
}

}  // namespace sim
