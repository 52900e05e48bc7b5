#include "sim/check/judged_point.hpp"

#include <fmt/format.h>

#include <set>

#include "sim/failure.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/scenario/canonical_text.hpp"
#include "sim/scenario/method.hpp"
#include "sim/scenario/sweep.hpp"

namespace sim {
namespace {

/// Outcomes of all frames are kept.
void refuse_many(const LoadedScenario& scenario, std::uint64_t frames) {
  constexpr std::uint64_t most = 10'000'000;
  if (frames > most)
    throw bad_input(fmt::format("stop.max_frames = {} in {}", frames, scenario.path.string()),
                    "the outcome of each is kept", fmt::format("take {} at most", most));
}

JudgedPoint judged_point(const LoadedScenario& loaded, std::size_t number) {
  const std::vector<double> coordinates = point_coordinates(loaded.sweep, number);
  JudgedPoint point{.name = point_name(loaded, coordinates),
                    .file = loaded.path,
                    .number = number,
                    .scenario = point_scenario(loaded, coordinates),
                    .frames = 0,
                    .physics = {}};
  refuse_weighted(point.scenario, "decoders are judged by trials as they come");
  refuse_marker(loaded, point.scenario.device.message);
  point.frames = static_cast<std::uint64_t>(point.scenario.stop.max_frames);
  refuse_many(loaded, point.frames);
  point.physics = canonical_text(point.scenario) +
                  fmt::format("simulation.seed = {}\n", point.scenario.simulation.seed);
  return point;
}

}  // namespace

std::string point_name(const LoadedScenario& scenario, const std::vector<double>& coordinates) {
  std::string name = scenario.path.stem().string();
  for (std::size_t i = 0; i < coordinates.size(); ++i)
    name += fmt::format(", {} = {}", scenario.sweep[i].key,
                        coordinate_text(scenario.sweep[i], coordinates[i]));
  return name;
}

void refuse_marker(const LoadedScenario& scenario, const std::string& message) {
  if (is_like_marker(message))
    throw bad_input("device.message = \"" + message + "\" in " + scenario.path.string(),
                    "decoders are judged between markers that say the same", "send another");
}

std::vector<JudgedPoint> judged_points(const LoadedScenario& scenario) {
  std::vector<JudgedPoint> points;
  for (std::size_t i = 0; i < count_points(scenario.sweep); ++i)
    points.push_back(judged_point(scenario, i));
  return points;
}

std::vector<JudgedPoint> judged_points(const std::vector<LoadedScenario>& scenarios) {
  std::vector<JudgedPoint> all;
  std::set<std::string> names;
  for (const LoadedScenario& scenario : scenarios)
    for (JudgedPoint& point : judged_points(scenario)) {
      if (!names.insert(point.name).second)
        throw bad_input(scenario.path.string(), "another scenario has the same name, and points",
                        "rename one");
      all.push_back(std::move(point));
    }
  return all;
}

JudgedLink judged_link(const JudgedPoint& point) {
  return {make_link(point.scenario), dsp::Hertz(point.scenario.device.baud)};
}

}  // namespace sim
