// What kinds of other light there are, with their numbers and defaults.
#include <utility>

#include "channel/ambient.hpp"
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

DisturbanceNumber depth(double standard) {
  return {{"modulation_depth", "1", from(0, 1), "amplitude of the ripple over the mean",
           "of its strongest line"},
          &DisturbanceSettings::modulation_depth,
          standard};
}

DisturbanceKind ripple_kind() {
  return {
      "ripple", "lamp at the mains", {light_irradiance(1), mains(), depth(0.1)}, LightWave::ripple};
}

DisturbanceNumber ballast(double standard) {
  return {{"ballast_hz", "Hz", from(2e4, 1e5), "frequency of the ballast",
           "the strongest line of the light is at twice that"},
          &DisturbanceSettings::ballast_hz,
          standard};
}

/// Moreira's model is of the light that is seen: its line is three times as deep as that of
/// `fluorescent_electronic`. 0.03 W/m2 are 2 uA in a PIN diode of 1 cm2 behind an infrared filter,
/// a figure recalled from the literature, not read.
DisturbanceKind fluorescent_kind() {
  return {"fluorescent",
          "fluorescent lamp at an electronic ballast (Moreira's model)",
          {light_irradiance(0.03),
           mains(),
           ballast(37500),
           {{"ballast_db_per_decade", "1", from(10, 20), "dB that a decade of a ballast line is",
             "20: the model's dB are of amplitude; 10: of power, as in its program listing"},
            &DisturbanceSettings::ballast_db_per_decade,
            20}},
          LightWave::fluorescent};
}

DisturbanceNumber pulses() {
  return {{"frequency_hz", "Hz", from(50, 5e4), "frequency of the pulses", ""},
          &DisturbanceSettings::frequency_hz,
          1000};
}

DisturbanceNumber pulse_duty(double standard) {
  return {{"duty", "1", from(0.01, 1), "lit fraction of a pulse's period", "1: not dimmed"},
          &DisturbanceSettings::duty,
          standard};
}

DisturbanceKind pwm_kind() {
  return {"pwm",
          "lamp dimmed by pulses",
          {light_irradiance(0.1), pulses(), pulse_duty(0.5)},
          LightWave::pulses};
}

// ---- lamps as they are bought ----

DisturbanceNumber illuminance(double standard) {
  return {{"lux", "lx", from(0, 200000), "illuminance of a lamp", "at the module"},
          &DisturbanceSettings::lux,
          standard};
}

/// 0.03 to 0.1: a filament's ripple, of which the eye sees 0.06 to 0.11, is 0.58 of that at 950 nm
/// (Wien's law).
DisturbanceKind incandescent_kind() {
  return {"incandescent",
          "incandescent lamp, 2856 K",
          {illuminance(100), mains(), depth(0.05)},
          LightWave::ripple,
          false,
          channel::tungsten_light};
}

/// Assumed, 0.02 to 0.08: thicker filaments.
DisturbanceKind halogen_kind() {
  return {"halogen",
          "halogen lamp, 3000 K",
          {illuminance(300), mains(), depth(0.04)},
          LightWave::ripple,
          false,
          channel::halogen_light};
}

DisturbanceKind sun_kind() {
  return {"sun", "sun and sky", {illuminance(10000)}, LightWave::steady, false, channel::daylight};
}

/// Assumed, 0.3 to 1: gas follows the current.
DisturbanceKind magnetic_kind() {
  return {"fluorescent_magnetic",
          "fluorescent lamp at a magnetic ballast",
          {illuminance(500), mains(), depth(0.8)},
          LightWave::ripple,
          false,
          channel::fluorescent_light};
}

/// Of 1000 lx the test of IrDA links (Hewlett-Packard, HSDL-3201 sheet, p. 19) has a square wave of
/// 0 to 3 mW/m2 between 850 and 900 nm, of which the fundamental is 0.17 of what a lamp has there;
/// 0.03 to 0.5 are likely. Ballasts have 20 to 100 kHz, compact lamps more than 40 (ENERGY STAR).
/// Some modules are made for such lamps, and no sheet says for which level: TSOP4456 suppresses
/// those of Vishay 82459 Fig. 13 and 14, TSOP574 is sold against compact ones (82434), Sharp's
/// GP1U78Q against those at inverters.
DisturbanceKind electronic_kind() {
  return {"fluorescent_electronic",
          "fluorescent lamp at an electronic ballast, in the infrared",
          {illuminance(500), mains(), ballast(45000), depth(0.15)},
          LightWave::fluorescent,
          false,
          channel::fluorescent_light};
}

DisturbanceKind led_panel_kind() {
  return {"led_panel",
          "white LEDs, dimmed by pulses or not",
          {illuminance(500), pulses(), pulse_duty(1)},
          LightWave::pulses,
          false,
          channel::white_led_light};
}

// ---- senders ----

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
          incandescent_kind(),
          halogen_kind(),
          sun_kind(),
          magnetic_kind(),
          electronic_kind(),
          led_panel_kind(),
          remote_kind(),
          {"cosys", "another COSYS device", sender(), LightWave::keyed, true},
          shared_link_kind(),
          {"carrier", "carrier without a pause, a jammer", keyed(0.001, 59e3, 0.5)}};
}

}  // namespace

const std::vector<DisturbanceKind>& disturbance_kinds() {
  static const std::vector<DisturbanceKind> kinds = make_kinds();
  return kinds;
}

}  // namespace sim
