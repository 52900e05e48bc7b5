#include "sim/guard/guard_keys.hpp"

#include "sim/scenario/key_making.hpp"

namespace sim {
namespace {

std::vector<Key> guard_keys() {
  constexpr SettingsOf<GuardSettings> at;
  using G = GuardSettings;
  std::vector<Key> keys{
      number("guard.line_baud", "Bd", from(50, 1e7), at, &G::line_baud,
             "line rate between guard and base station", "both ways at once, 8N1"),
      number("guard.byte_error_ratio", "1", from(0, 1), at, &G::byte_error_ratio,
             "share of bytes on that line of which one bit is wrong"),
      number("guard.outage_every_s", "s", from(0, 1e6), at, &G::outage_every_s,
             "mean time from one outage of that line to the next", "exponential; 0: none"),
      number("guard.outage_for_s", "s", from(0.001, 1e6), at, &G::outage_for_s,
             "mean length of an outage", "exponential; all bytes are lost in it"),
      number("guard.transmit_every_ms", "ms", from(1, 1e6), at, &G::transmit_every_ms,
             "time from one turn of guard and base station to send to the next",
             "one is left out while the line is busy"),
      number("guard.full_set_every_s", "s", from(0, 1e6), at, &G::full_set_every_s,
             "time from one full set of values to the next", "SharedLink: usually once a second"),
      flag("guard.compressed", at, &G::compressed, "values that have not changed are left out",
           "but for full sets"),
      number("guard.query_age_s", "s", from(0.01, 1e6), at, &G::query_age_s,
             "time without a device's value after which the base station asks for it"),
      number("guard.query_timeout_s", "s", from(0.01, 1e6), at, &G::query_timeout_s,
             "time after which a question has no answer"),
  };
  // What is behind the arena does not tell its points apart: what devices send and the guard hears
  // is the same whatever the line does to it.
  for (Key& key : keys) key.physics = false;
  return keys;
}

}  // namespace

constinit const ExperimentKind guard_kind{
    .name = "guard",
    .tables = {"path.", "device.pulse_us", "arena.", "devices.", "guard.", "stop.target_flr"},
    .amount = "arena.runs",
    .keys = guard_keys};

}  // namespace sim
