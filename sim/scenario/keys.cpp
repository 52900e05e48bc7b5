#include "sim/scenario/keys.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "channel/conditions.hpp"
#include "protocol/uart_receivers.hpp"
#include "sim/scenario/disturbance_keys.hpp"
#include "sim/scenario/experiment_kind.hpp"
#include "sim/scenario/fidelity.hpp"
#include "sim/scenario/key_making.hpp"
#include "sim/scenario/method.hpp"
#include "sim/scenario/placed_device_keys.hpp"

namespace sim {
namespace {

constexpr double largest_whole = 9007199254740991;  // 2^53 - 1: every one up to it is exact

Key title_key() {
  return no_physics(
      {{"title", "", {}, "name of the experiment", "before the first table", KeyType::text},
       {},
       [](Scenario& s) -> std::string& { return s.title; },
       {}});
}

Key experiment_key() {
  Key key{{"experiment", "", {}, "what is simulated", "before the first table", KeyType::choice},
          {},
          [](Scenario& s) -> std::string& { return s.experiment; },
          {}};
  key.swept = false;
  return younger(key);
}

std::vector<Key> device_keys() {
  constexpr auto at = &Scenario::device;
  using D = DeviceSettings;
  return {
      text(KeyType::message, "device.message", at, &D::message, "COSYS device message",
           "sent with its checksum and a newline"),
      number("device.baud", "Bd", from(1, 1e5), at, &D::baud, "line rate of the UART", "8N1"),
      number("device.clock_error_ppm", "1e-6", from(-1e5, 1e5), at, &D::clock_error_ppm,
             "clock error of the sending UART", "positive: fast"),
      number("device.start_jitter_us", "us", from(0, 1e5), at, &D::start_jitter_us,
             "random lateness of each character's start", "uniform from 0 to this"),
      number("device.interval_min_ms", "ms", from(0, 1e6), at, &D::interval_min_ms,
             "shortest pause between messages", "end of one to start of the next"),
      number("device.interval_max_ms", "ms", from(0, 1e6), at, &D::interval_max_ms,
             "longest pause between messages", "pauses are uniform between the two"),
      number("device.carrier_hz", "Hz", from(1e3, 1e6), at, &D::carrier_hz,
             "nominal carrier frequency"),
      number("device.carrier_error_ppm", "1e-6", from(-2e5, 2e5), at, &D::carrier_error_ppm,
             "error of the carrier frequency", "of a 555 timer up to 17 % (SNAS558N)"),
      number("device.carrier_duty", "1", from(0.01, 0.99), at, &D::carrier_duty,
             "lit fraction of a carrier period"),
      younger(number("device.pulse_us", "us", from(0, 1e6), at, &D::pulse_us,
                     "light of each 0 bit, from its start on",
                     "0: the whole bit; 158 at 2400 Bd: a short burst for any module (Vishay)")),
  };
}

std::vector<Key> led_settings_keys() {
  constexpr auto at = &Scenario::led;
  using L = LedSettings;
  return {
      text(KeyType::part, "led.part", at, &L::part, "LED", "a file in `leds/`"),
      number(
          "led.current_ma", "mA", from(0.01, 1500), at, &L::current_ma, "LED current while lit",
          "not beyond the part's curve; TSAL6200: 997, in pulses of 100 us (Vishay 81010 Fig. 5)"),
      number("led.height_mm", "mm", from(0.1, 1e4), at, &L::height_mm,
             "LED height above the floor"),
      number("led.temperature_c", "degree_C", from(-60, 150), at, &L::temperature_c,
             "temperature of the LED", "other than 25 where its part has the curve"),
      number("led.yaw_deg", "degree", from(-180, 180), at, &L::yaw_deg,
             "direction of the LED along the floor", "0: towards bearing 0"),
      number("led.elevation_deg", "degree", from(-90, 90), at, &L::elevation_deg,
             "elevation of the LED's axis", "positive: up"),
  };
}

std::vector<Key> receiver_keys() {
  constexpr auto at = &Scenario::receiver;
  using R = ReceiverSettings;
  return {
      text(KeyType::part, "receiver.module", at, &R::module, "receiver module",
           "a file in `modules/`"),
      number("receiver.ebn0_db", "dB", from(-30, 60), at, &R::ebn0_db,
             "energy of a bit over the noise density",
             "sets the light, and geometry and LED are then only labels; half of the bits being "
             "light, so coherent OOK has BER = Q(sqrt(Eb/N0))"),
      number("receiver.range_m", "m", from(0.01, 1000), at, &R::range_m,
             "distance along the floor"),
      number("receiver.bearing_deg", "degree", from(-180, 180), at, &R::bearing_deg,
             "bearing of the receiver from the LED", "counter-clockwise from the x axis"),
      number("receiver.height_mm", "mm", from(0.1, 1e4), at, &R::height_mm,
             "receiver height above the floor"),
      number("receiver.yaw_deg", "degree", from(-180, 180), at, &R::yaw_deg,
             "turn of the receiver away from the LED"),
      number("receiver.tilt_deg", "degree", from(-90, 90), at, &R::tilt_deg, "tilt of the receiver",
             "positive: up"),
      number("receiver.temperature_c", "degree_C", from(-60, 150), at, &R::temperature_c,
             "temperature of the module", "where its sheet shows Emin against it"),
      number("receiver.supply_v", "V", from(1.5, 30), at, &R::supply_v,
             "supply voltage of the module", "unset: as its sheet's typical values"),
      number("receiver.supply_ripple_mv", "mV", from(0, 1e4), at, &R::supply_ripple_mv,
             "rms ripple of the supply", "where the module's sheet shows Emin against it"),
      text(KeyType::choice, "receiver.supply_ripple_at", at, &R::supply_ripple_at,
           "frequency of that ripple", "`f0` is the module's centre, the worst",
           names_of(channel::ripple_frequencies())),
      younger(whole("receiver.unit", "1", from(0, 1e6), at, &R::unit, "number of a drawn unit",
                    "what nobody printed of module, LEDs and floor within its bounds, centre and "
                    "threshold within theirs; 0: the parts as their files have them")),
      with_words(
          flag("receiver.population", at, &R::population, "another unit of the part in each trial",
               "`true` or `parts`: centre within its tolerance, threshold between typical "
               "and maximum; `constants`: besides, what nobody printed within its bounds"),
          {"false", "parts", "constants"}),
  };
}

/// Keys that change single numbers of a part.
template <class Part>
std::vector<Key> override_keys(const std::string& table, const PartKeys<Part>& part,
                               Part Scenario::*at) {
  std::vector<Key> keys;
  for (const auto& n : part.numbers)
    keys.push_back(number(table + "." + n.facts.name, n.facts.unit, n.facts.range, at, n.member,
                          n.facts.long_name, n.facts.note));
  return keys;
}

std::vector<Key> floor_part_keys() {
  return {text(KeyType::part, "floor.part", &Scenario::floor_settings, &FloorSettings::part,
               "floor", "a file in `floors/`")};
}

std::vector<Key> bump_keys() {
  constexpr auto floor = &Scenario::floor;
  using F = channel::Floor;
  return {
      number("floor.bump_height_mm", "mm", from(0, 1e4), floor, &F::bump_height_mm,
             "height of a bump across the way", "light that meets it is lost; 0: none"),
      number("floor.bump_position", "1", from(0.01, 0.99), floor, &F::bump_position,
             "place of the bump", "share of the way from LED to receiver"),
  };
}

std::vector<Key> surroundings_keys() {
  return {
      text(KeyType::choice, "uart.receiver", &Scenario::uart, &UartSettings::receiver,
           "listening UART",
           "majority of three of 16 samples; one in mid-bit; Arduino's; widths of pulses",
           names_of(protocol::uart_receivers())),
      number("uart.clock_error_ppm", "1e-6", from(-1e5, 1e5), &Scenario::uart,
             &UartSettings::clock_error_ppm, "clock error of the listening UART", "positive: fast"),
      younger(flag("uart.monostable", &Scenario::uart, &UartSettings::monostable,
                   "whether each pulse of `device.pulse_us` is made a whole bit before the UART",
                   "without, the UART must see the pulse in the middle of its bit")),
      number("ambient.irradiance_w_per_m2", "W/m2", from(0, 1000), &Scenario::ambient,
             &AmbientSettings::irradiance_w_per_m2, "steady ambient irradiance",
             "as if at 950 nm; 10: 1.4 klx of tungsten or 8.2 klx of day (Vishay 82459 Fig. 6)"),
      number("ambient.daylight_lux", "lx", from(0, 2e5), &Scenario::ambient,
             &AmbientSettings::daylight_lux, "daylight besides that", "direct sun: about 100000"),
      number("ambient.tungsten_lux", "lx", from(0, 2e5), &Scenario::ambient,
             &AmbientSettings::tungsten_lux, "light of incandescent lamps besides that",
             "their ripple is a disturbance"),
      number("noise.scale", "1", from(0, 100), &Scenario::noise, &NoiseSettings::scale,
             "factor on the rms of all noise", "0: no noise"),
  };
}

std::vector<Key> run_keys() {
  constexpr auto run = &Scenario::simulation;
  return {
      younger(
          text(KeyType::choice, "simulation.fidelity", run, &SimulationSettings::fidelity,
               "fidelity of light and receiver",
               "every sample; or, without other lights, for a module one step a carrier cycle, for "
               "the ideal receivers one decision a bit (`sim/README.md`)",
               names_of(fidelities()))),
      younger(text(KeyType::choice, "simulation.method", run, &SimulationSettings::method,
                   "method of counting errors",
                   "trials as they come; or, for rare errors, trials drawn to fail, with weights "
                   "(`sim/README.md`)",
                   names_of(methods()))),
      number(
          "simulation.sample_rate_hz", "Hz", from(2e5, 2e7), run,
          &SimulationSettings::sample_rate_hz, "sample rate of the light",
          "the default agrees with four times as much; not given, fast bits and carriers raise it"),
      whole("simulation.warmup_messages", "1", from(0, 100), run,
            &SimulationSettings::warmup_messages, "messages sent before counting starts",
            "they settle the gain control"),
      no_physics(whole("simulation.seed", "1", from(0, largest_whole), run,
                       &SimulationSettings::seed, "seed of all randomness")),
  };
}

std::vector<Key> stop_keys() {
  constexpr auto stop = &Scenario::stop;
  std::vector<Key> keys{
      whole("stop.max_frames", "1", from(1, 4e9), stop, &StopSettings::max_frames,
            "messages after which a point ends", "trial numbers are 32 bits"),
      whole("stop.max_frame_errors", "1", from(0, 1e12), stop, &StopSettings::max_frame_errors,
            "lost messages after which a point ends",
            "under importance sampling as many as weights are worth; 0: no such limit"),
      number(
          "stop.rel_ci", "1", from(0, 1), stop, &StopSettings::rel_ci,
          "half width of the 95 % interval of what is measured, over its value, at which a point "
          "is finished",
          "of a link the bit error ratio, of others their first figure; 0: no such rule"),
      number("stop.target_flr", "1", from(0, 1), stop, &StopSettings::target_flr,
             "frame loss ratio; a point is finished when its own is surely below or above",
             "by its 99.9 % interval; 0: no such rule"),
  };
  for (Key& key : keys) key.physics = false;
  return keys;
}

/// The keys of all experiments. Those of one experiment alone stand behind the others, in the order
/// in which it became known, so that a key stays where it is when another becomes known.
class KeyTable {
 public:
  KeyTable() {
    for (const auto& group :
         {std::vector<Key>{title_key(), experiment_key()}, device_keys(), led_settings_keys(),
          receiver_keys(), override_keys("module", module_keys(), &Scenario::module),
          floor_part_keys(), override_keys("floor", floor_keys(), &Scenario::floor), bump_keys(),
          surroundings_keys(), run_keys(), stop_keys(), path_keys()})
      keys_.insert(keys_.end(), group.begin(), group.end());
    shared_ = keys_.size();
  }

  const std::deque<Key>& of(const std::vector<const ExperimentKind*>& kinds) {
    if (kinds == kinds_) return keys_;
    keys_.erase(keys_.begin() + static_cast<std::ptrdiff_t>(shared_), keys_.end());
    std::vector<std::string>& names =
        std::ranges::find(keys_, std::string("experiment"), &Key::name)->choices;
    names.clear();
    for (const ExperimentKind* kind : kinds) {
      names.emplace_back(kind->name);
      if (kind->keys != nullptr)
        for (Key& key : kind->keys()) keys_.push_back(std::move(key));
    }
    kinds_ = kinds;
    return keys_;
  }

 private:
  std::deque<Key> keys_;
  std::size_t shared_ = 0;
  std::vector<const ExperimentKind*> kinds_;  // whose keys there are
};

}  // namespace

std::string part_giving(const std::string& name) {
  if (name.starts_with("module.")) return "receiver.module";
  const bool of_floor = std::ranges::any_of(
      floor_keys().numbers, [&](const auto& n) { return name == "floor." + n.facts.name; });
  return of_floor ? "floor.part" : "";
}

const std::deque<Key>& scenario_keys() {
  static KeyTable table;
  return table.of(experiment_kinds());
}

const Key* find_key(const std::string& name) {
  const auto& keys = scenario_keys();
  const auto at = std::ranges::find(keys, name, &Key::name);
  if (at != keys.end()) return &*at;
  const Key* disturbance = find_disturbance_key(name);
  return disturbance != nullptr ? disturbance : find_placed_device_key(name);
}

}  // namespace sim
