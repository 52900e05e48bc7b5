#pragma once
// A point of a scenario at which decoders are judged.
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/check/delimited_stream.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

struct JudgedPoint {
  std::string name;            // "quickstart, receiver.range_m = 3", of one check no two alike
  std::filesystem::path file;  // of the scenario
  std::uint64_t number;        // of the point, as of --point
  Scenario scenario;
  std::uint64_t frames;  // that a baseline has of it unless told otherwise
  std::string physics;   // all that decides its light, a line a key
};

/// "quickstart, receiver.range_m = 3"
std::string point_name(const LoadedScenario& scenario, const std::vector<double>& coordinates);

/// Throws where a scenario's device would say what stands between frames.
void refuse_marker(const LoadedScenario& scenario, const std::string& message);

/// All points of a scenario. Throws Failure(bad_input) for what decoders cannot be judged at.
std::vector<JudgedPoint> judged_points(const LoadedScenario& scenario);

/// Of several scenarios, which must have names of their own.
std::vector<JudgedPoint> judged_points(const std::vector<LoadedScenario>& scenarios);

JudgedLink judged_link(const JudgedPoint& point);

}  // namespace sim
