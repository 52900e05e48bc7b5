#include "sim/shared_link/shared_link_keys.hpp"

#include "sim/scenario/key_making.hpp"

namespace sim {
namespace {

std::vector<Key> shared_link_keys() {
  constexpr SettingsOf<SharedLinkSettings> at;
  using E = SharedLinkSettings;
  return all_younger({
      whole("exchange.variables", "1", from(1, 100), at, &E::variables,
            "variables of each node's outbound list"),
      whole("exchange.value_characters", "1", from(1, 40), at, &E::value_characters,
            "characters of a value", "digits"),
      number("exchange.change_every_s", "s", from(0.01, 1e6), at, &E::change_every_s,
             "mean time from one change of a variable to the next", "exponential"),
      number("exchange.query_every_s", "s", from(0, 1e6), at, &E::query_every_s,
             "mean time from one question of a node to the next",
             "exponential, for a variable at random; 0: none"),
      number("exchange.query_timeout_s", "s", from(0.01, 1e6), at, &E::query_timeout_s,
             "time after which a question has no answer"),
      number("exchange.interval_min_ms", "ms", from(10, 1e6), at, &E::interval_min_ms,
             "shortest pause of a node between two turns", "end of one to start of the next"),
      number("exchange.interval_max_ms", "ms", from(10, 1e6), at, &E::interval_max_ms,
             "longest pause of a node between two turns",
             "pauses are uniform between the two, and longer while the other is heard"),
      number("exchange.quiet_ms", "ms", from(0, 1e4), at, &E::quiet_ms,
             "time without a character, whoever sent it, after which a node may send",
             "a character takes 17 ms at 600 Bd"),
      number("exchange.full_set_every_s", "s", from(0, 1e6), at, &E::full_set_every_s,
             "time from one full set of values to the next"),
      flag("exchange.compressed", at, &E::compressed, "values that have not changed are left out",
           "but for full sets"),
      flag("exchange.own_reflection", at, &E::own_reflection,
           "each module gets what the floor reflects of its own node's LED",
           "false: a shield that no real one is"),
      number("exchange.led_offset_mm", "mm", from(1, 1000), at, &E::led_offset_mm,
             "distance of a node's LED from its module", "side by side"),
      number("exchange.duration_s", "s", from(1, 86400), at, &E::duration_s,
             "simulated time of a run"),
      no_physics(whole("exchange.runs", "1", from(1, 1e6), at, &E::runs,
                       "runs of each point, with random numbers of their own")),
  });
}

}  // namespace

constinit const ExperimentKind shared_link_kind{
    .name = "sharedlink",
    .tables = {"exchange.", "led.yaw_deg", "receiver.range_m", "receiver.bearing_deg",
               "device.clock_error_ppm", "device.carrier_error_ppm", "stop.target_flr"},
    .amount = "exchange.runs",
    .keys = shared_link_keys};

}  // namespace sim
