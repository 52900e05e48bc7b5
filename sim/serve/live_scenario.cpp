#include "sim/serve/live_scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "sim/failure.hpp"
#include "sim/loading/load_scenario.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/scenario/experiment_kind.hpp"
#include "sim/scenario/method.hpp"
#include "sim/scenario/source_locations.hpp"
#include "sim/scenario/sweep.hpp"

namespace sim {
namespace {

/// Of what the experiment is, and how its trials are run.
constexpr std::array<std::string_view, 3> fixed_keys{"experiment", "simulation.", "stop."};

void refuse_fixed(const std::string& key) {
  const auto is_of = [&](std::string_view fixed) { return key.starts_with(fixed); };
  if (std::ranges::none_of(fixed_keys, is_of)) return;
  throw bad_input("cannot change " + key, "it says how the line is simulated",
                  "end this one and start another with --set");
}

void refuse_sweep(const LoadedScenario& loaded) {
  if (count_points(loaded.sweep) == 1) return;
  const auto has_several = [](const Axis& axis) { return axis.values.size() > 1; };
  const Axis& axis = *std::ranges::find_if(loaded.sweep, has_several);
  const std::string first =
      axis.is_text() ? axis.labels.front() : fmt::format("{}", axis.values.front());
  throw bad_input(
      fmt::format("{} has several values {}", axis.key, place_of(loaded.places, axis.key)),
      "a line is at one point", fmt::format("give one, such as {}={}", axis.key, first));
}

void refuse_lone_messages(const Scenario& point, const SourceLocations& places) {
  if (point.simulation.warmup_messages > 0) return;
  throw bad_input(
      "simulation.warmup_messages = 0 " + place_of(places, "simulation.warmup_messages"),
      "a trial of one message has no pause that could be played", "use at least 1");
}

}  // namespace

LiveScenario::LiveScenario(ScenarioSource source)
    : source_(std::move(source)), link_(link_with({})) {}

void LiveScenario::set(const std::string& change) {
  const std::string key = change.substr(0, change.find('='));
  refuse_fixed(key);
  std::vector<std::string> changes = changes_;
  std::erase_if(changes, [&](const std::string& old) { return old.starts_with(key + "="); });
  changes.push_back(change);
  link_ = link_with(changes);
  changes_ = std::move(changes);
}

std::shared_ptr<const Link> LiveScenario::link_with(const std::vector<std::string>& changes) const {
  std::vector<std::string> overrides = source_.overrides;
  overrides.insert(overrides.end(), changes.begin(), changes.end());
  const LoadedScenario loaded =
      parse_scenario(source_.text, source_.path, overrides, source_.roots);
  check_keys_of_experiment(loaded);
  refuse_sweep(loaded);
  const Scenario point = numbered_point(loaded, 0);
  refuse_weighted(point, "a line carries messages as they come");
  refuse_lone_messages(point, loaded.places);
  return std::make_shared<const Link>(make_link(point));
}

}  // namespace sim
