#include "sim/false_accepts/false_accept_keys.hpp"

#include "sim/scenario/disturbance_keys.hpp"
#include "sim/scenario/key_making.hpp"

namespace sim {
namespace {

std::vector<std::string> airs() {
  std::vector<std::string> names{FalseAcceptSettings{}.air};
  for (const DisturbanceKind& kind : disturbance_kinds()) names.push_back(kind.name);
  return names;
}

std::vector<Key> false_accept_keys() {
  constexpr SettingsOf<FalseAcceptSettings> at;
  using L = FalseAcceptSettings;
  return all_younger({
      flag("listening.device_sends", at, &L::device_sends, "the device sends its message",
           "false: it stays dark"),
      text(KeyType::choice, "listening.air", at, &L::air, "what shines besides",
           "another light of that kind, as its defaults are; `[disturbance.NAME]` adds others",
           airs()),
      number("listening.duration_s", "s", from(1, 3600), at, &L::duration_s,
             "time that a run listens", "each begins anew, in the midst of whatever shines"),
      no_physics(whole("listening.runs", "1", from(1, 1e6), at, &L::runs,
                       "runs of each point, with random numbers of their own")),
  });
}

}  // namespace

constinit const ExperimentKind false_accept_kind{
    .name = "listening",
    .tables = {"listening.", "device.", "receiver.", "led.yaw_deg"},
    .amount = "listening.runs",
    .keys = false_accept_keys};

}  // namespace sim
