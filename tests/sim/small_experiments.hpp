#pragma once
// Of each experiment that is not a link a scenario that takes some tenths of a second.
#include <fmt/format.h>

#include <string>

namespace sim::test {

struct Experiment {
  const char *name, *scenario, *sweep;
};

inline constexpr const char* devices = R"(receiver.module = "TSSP4056"
simulation.sample_rate_hz = 250000
path.x_m = [0, 1]
arena.runs = 2
[devices.near]
x_m = 1.5
yaw_deg = 180
messages = "NEAR"
[devices.away]
x_m = 50
messages = "AWAY"
)";
inline constexpr const char* two_axes = "devices.near.x_m = [1.5, 2]\ndevices.near.y_m = [0, 0.1]";
inline const Experiment small_experiments[] = {
    {"arena", devices, two_axes},
    {"guard", devices, two_axes},
    {"sharedlink", "receiver.module = \"TSSP4056\"\nexchange.duration_s = 5\nexchange.runs = 1\n",
     "receiver.range_m = [1, 12.5]"},
    {"presence", "presence.trials = 8\n", "receiver.range_m = [1, 400]"},
    {"location",
     "location.trials = 1\nlocation.x_m = [0, 3]\nlocation.y_m = [0, 0]\n"
     "location.heading_deg = [45, 135]\nfloor.part = \"none\"\n",
     "location.relative_sigma = \"0.01:0.01:0.21\""},
    {"listening",
     "receiver.module = \"TSSP4056\"\nlistening.device_sends = false\n"
     "listening.duration_s = 10\nlistening.runs = 1\n",
     "receiver.range_m = [1, 50]"}};

inline std::string scenario_of(const Experiment& experiment, bool swept) {
  return fmt::format("experiment = \"{}\"\n{}{}", experiment.name, experiment.scenario,
                     swept ? fmt::format("[sweep]\n{}\n", experiment.sweep) : "");
}

}  // namespace sim::test
