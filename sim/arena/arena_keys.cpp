#include "sim/arena/arena_keys.hpp"

#include "sim/scenario/key_making.hpp"

namespace sim {
namespace {

std::vector<Key> arena_keys() {
  constexpr SettingsOf<ArenaSettings> at;
  return all_younger({
      number("arena.duration_s", "s", from(0.1, 86400), at, &ArenaSettings::duration_s,
             "simulated time of a run", "unset: what the way takes, 60 if it is one place"),
      no_physics(whole("arena.runs", "1", from(1, 1e6), at, &ArenaSettings::runs,
                       "runs of each point, with random numbers of their own")),
  });
}

}  // namespace

constinit const ExperimentKind arena_kind{
    .name = "arena",
    .tables = {"path.", "device.pulse_us", "arena.", "devices.", "stop.target_flr"},
    .amount = "arena.runs",
    .keys = arena_keys};

}  // namespace sim
