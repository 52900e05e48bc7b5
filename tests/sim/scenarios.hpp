#pragma once
// Scenarios for tests, from text, with the project's own parts.
#include <filesystem>
#include <string>
#include <vector>

#include "gtest/gtest.h"
#include "sim/failure.hpp"
#include "sim/link/link.hpp"
#include "sim/loading/load_scenario.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

/// Those that the project ships, with its parts.
inline const std::filesystem::path scenarios = COSYS_SOURCE_DIR "/scenarios";

inline LoadedScenario loaded(const std::string& text, const std::vector<std::string>& set = {}) {
  return parse_scenario(text, "x.toml", set, {scenarios});
}

/// The line that refuses such a scenario; "accepted" if none does.
inline std::string refusal(const std::string& text, const std::vector<std::string>& set = {}) {
  try {
    loaded(text, set);
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::bad_input);
    return failure.what();
  }
  return "accepted";
}

/// Keys as of --set, and more of them.
inline std::vector<std::string> with_keys(std::vector<std::string> keys,
                                          const std::vector<std::string>& more) {
  keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

/// One point, with keys set as of --set.
inline Link link_of(const std::vector<std::string>& set) {
  return make_link(point_scenario(loaded("", set), {}));
}

/// No noise, no AGC, 1 m: what is sent arrives.
inline std::vector<std::string> clear_link(std::vector<std::string> set = {}) {
  set.insert(set.begin(), {"noise.scale=0", "module.agc_attack_db_per_ms=0", "receiver.range_m=1"});
  return set;
}

}  // namespace sim
