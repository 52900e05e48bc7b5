// What kinds of other light there are, with their numbers and defaults.
#include <utility>

#include "sim/scenario/disturbance_keys.hpp"

namespace sim {
namespace {

DisturbanceNumber light_irradiance(double standard) {
  return {{"irradiance_w_per_m2", "W/m2", from(0, 1000), "irradiance of another light",
           "mean of a lamp, peak of an on/off wave; at the module, as if at 950 nm"},
          &DisturbanceSettings::irradiance_w_per_m2,
          standard};
}

DisturbanceNumber mains() {
  return {{"mains_hz", "Hz", from(40, 70), "frequency of the mains", "the light's is twice that"},
          &DisturbanceSettings::mains_hz,
          50};
}

DisturbanceKind ripple_kind() {
  return {"ripple",
          "lamp at the mains",
          {light_irradiance(1),
           mains(),
           {{"modulation_depth", "1", from(0, 1), "amplitude of the ripple over the mean",
             "of incandescent lamps assumed: 0.05 to 0.1"},
            &DisturbanceSettings::modulation_depth,
            0.1}}};
}

DisturbanceKind fluorescent_kind() {
  return {"fluorescent",
          "fluorescent lamp at an electronic ballast (Moreira's model)",
          {light_irradiance(0.03),
           mains(),
           {{"ballast_hz", "Hz", from(2e4, 1e5), "frequency of the ballast",
             "the strongest line of the light is at twice that"},
            &DisturbanceSettings::ballast_hz,
            37500},
           {{"ballast_db_per_decade", "1", from(10, 20), "dB that a decade of a ballast line is",
             "20: the model's dB are of amplitude; 10: of power, as in its program listing"},
            &DisturbanceSettings::ballast_db_per_decade,
            20}}};
}

DisturbanceKind pwm_kind() {
  return {"pwm",
          "lamp dimmed by pulses",
          {light_irradiance(0.1),
           {{"frequency_hz", "Hz", from(50, 5e4), "frequency of the pulses", ""},
            &DisturbanceSettings::frequency_hz,
            1000},
           {{"duty", "1", from(0.01, 0.99), "lit fraction of a pulse's period", ""},
            &DisturbanceSettings::duty,
            0.5}}};
}

std::vector<DisturbanceNumber> keyed(double peak, double carrier_hz, double duty) {
  return {light_irradiance(peak),
          {{"carrier_hz", "Hz", from(1e3, 1e6), "carrier frequency of another light", ""},
           &DisturbanceSettings::carrier_hz,
           carrier_hz},
          {{"carrier_duty", "1", from(0.01, 0.99), "lit fraction of its carrier period", ""},
           &DisturbanceSettings::carrier_duty,
           duty}};
}

DisturbanceNumber duration(std::string name, double low, double DisturbanceSettings::*member,
                           double standard, std::string long_name, std::string note) {
  return {{std::move(name), "ms", from(low, 1e4), std::move(long_name), std::move(note)},
          member,
          standard};
}

/// By default NEC's: 9 ms and 4.5 ms, then 33 bursts of 562.5 us whose gaps say 0 or 1.
DisturbanceKind remote_kind() {
  DisturbanceKind kind{"remote", "remote control", keyed(0.03, 38e3, 1 / 3.0)};
  kind.numbers.insert(
      kind.numbers.end(),
      {duration("leader_ms", 0, &DisturbanceSettings::leader_ms, 9, "first burst of a frame",
                "0: none"),
       duration("leader_gap_ms", 0.05, &DisturbanceSettings::leader_gap_ms, 4.5,
                "gap behind that burst", ""),
       duration("burst_ms", 0.05, &DisturbanceSettings::burst_ms, 0.5625, "burst of a frame",
                "RC-5: 0.889"),
       duration("gap_min_ms", 0.05, &DisturbanceSettings::gap_min_ms, 0.5625,
                "shorter gap of a frame", "each gap is one of the two, at random; RC-5: 0.889"),
       duration("gap_max_ms", 0.05, &DisturbanceSettings::gap_max_ms, 1.6875,
                "longer gap of a frame", "RC-5: 1.778"),
       {{"bursts", "1", from(1, 1000), "bursts of a frame", "its first aside; RC-5: about 11",
         KeyType::whole_number},
        &DisturbanceSettings::bursts,
        33},
       duration("repetition_ms", 1, &DisturbanceSettings::repetition_ms, 108,
                "start of a frame to that of the next", "RC-5: 113.8")});
  return kind;
}

/// What sends messages, with a pause behind each.
std::vector<DisturbanceNumber> sender() {
  std::vector<DisturbanceNumber> numbers = keyed(0.03, 59e3, 0.5);
  numbers.insert(
      numbers.end(),
      {{{"baud", "Bd", from(1, 1e5), "line rate of the other device", "8N1"},
        &DisturbanceSettings::baud,
        600},
       duration("interval_min_ms", 0, &DisturbanceSettings::interval_min_ms, 100,
                "shortest pause of that device", "end of a message to start of the next"),
       duration("interval_max_ms", 0, &DisturbanceSettings::interval_max_ms, 900,
                "longest pause of that device", "pauses are uniform between the two")});
  return numbers;
}

DisturbanceKind shared_link_kind() {
  DisturbanceKind kind{"sharedlink", "SharedLink node", sender()};
  kind.numbers.push_back({{"variables", "1", from(1, 20), "values in each of its messages",
                           "seven characters, digits at random", KeyType::whole_number},
                          &DisturbanceSettings::variables,
                          4});
  return kind;
}

std::vector<DisturbanceKind> make_kinds() {
  return {ripple_kind(),
          fluorescent_kind(),
          pwm_kind(),
          remote_kind(),
          {"cosys", "another COSYS device", sender(), true},
          shared_link_kind(),
          {"carrier", "carrier without a pause, a jammer", keyed(0.001, 59e3, 0.5)}};
}

}  // namespace

const std::vector<DisturbanceKind>& disturbance_kinds() {
  static const std::vector<DisturbanceKind> kinds = make_kinds();
  return kinds;
}

}  // namespace sim
