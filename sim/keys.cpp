#include "sim/keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sim {
namespace {

constexpr std::size_t longest_message = 250;        // a line of 256 bytes less checksum and newline
constexpr double largest_whole = 9007199254740991;  // 2^53 - 1: every one up to it is exact

Range above(double low, double high) { return {low, high, true}; }
Range from(double low, double high) { return {low, high, false}; }

template <class Group>
Key number(std::string name, std::string unit, Range range, Group Scenario::*group,
           double Group::*member, std::string long_name, std::string note = "",
           KeyType type = KeyType::number) {
  return {{std::move(name), std::move(unit), range, std::move(long_name), std::move(note), type},
          [=](Scenario& s) -> double& { return s.*group.*member; },
          {},
          {}};
}

template <class... Rest>
Key whole(Rest&&... rest) {
  Key key = number(std::forward<Rest>(rest)...);
  key.facts.type = KeyType::whole_number;
  return key;
}

template <class Group>
Key text(KeyType type, std::string name, Group Scenario::*group, std::string Group::*member,
         std::string long_name, std::string note = "", std::vector<std::string> choices = {}) {
  return {{std::move(name), "", {}, std::move(long_name), std::move(note), type},
          {},
          [=](Scenario& s) -> std::string& { return s.*group.*member; },
          std::move(choices)};
}

Key title_key() {
  return {{"title", "", {}, "name of the experiment", "before the first table", KeyType::text},
          {},
          [](Scenario& s) -> std::string& { return s.title; },
          {}};
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
  };
}

std::vector<Key> led_settings_keys() {
  constexpr auto at = &Scenario::led;
  using L = LedSettings;
  return {
      text(KeyType::part, "led.part", at, &L::part, "LED", "a file in `leds/`"),
      number("led.current_ma", "mA", above(0, 1500), at, &L::current_ma, "LED current while lit",
             "surge limit 1.5 A (Vishay 81010)"),
      number("led.height_mm", "mm", above(0, 1e4), at, &L::height_mm, "LED height above the floor"),
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
      number("receiver.range_m", "m", above(0, 1000), at, &R::range_m, "distance along the floor"),
      number("receiver.bearing_deg", "degree", from(-180, 180), at, &R::bearing_deg,
             "bearing of the receiver from the LED", "counter-clockwise from the x axis"),
      number("receiver.height_mm", "mm", above(0, 1e4), at, &R::height_mm,
             "receiver height above the floor"),
      number("receiver.yaw_deg", "degree", from(-180, 180), at, &R::yaw_deg,
             "turn of the receiver away from the LED"),
      number("receiver.tilt_deg", "degree", from(-90, 90), at, &R::tilt_deg, "tilt of the receiver",
             "positive: up"),
  };
}

std::vector<Key> module_override_keys() {
  std::vector<Key> keys;
  for (const auto& n : module_keys().numbers)
    keys.push_back(number("module." + n.facts.name, n.facts.unit, n.facts.range, &Scenario::module,
                          n.member, n.facts.long_name, n.facts.note));
  return keys;
}

std::vector<Key> surroundings_keys() {
  constexpr auto floor = &Scenario::floor;
  using F = channel::Floor;
  return {
      number("floor.refractive_index", "1", from(1, 4), floor, &F::refractive_index,
             "refractive index of the floor's surface", "1: no mirror image; varnish, vinyl: 1.5"),
      number("floor.roughness_um", "um", from(0, 1e4), floor, &F::roughness_um,
             "rms roughness of the floor", "weakens the mirror image"),
      number("floor.diffuse_reflectance", "1", from(0, 1), floor, &F::diffuse_reflectance,
             "diffuse reflectance of the floor"),
      text(KeyType::choice, "uart.receiver", &Scenario::uart, &UartSettings::receiver,
           "listening UART", "16 samples a bit, majority of three; or one sample in mid-bit",
           {"atmega", "mid-bit"}),
      number("uart.clock_error_ppm", "1e-6", from(-1e5, 1e5), &Scenario::uart,
             &UartSettings::clock_error_ppm, "clock error of the listening UART", "positive: fast"),
      number("ambient.irradiance_w_per_m2", "W/m2", from(0, 1000), &Scenario::ambient,
             &AmbientSettings::irradiance_w_per_m2, "steady ambient irradiance",
             "as if at 950 nm; 10: 1.4 klx of tungsten or 8.2 klx of day (Vishay 82459 Fig. 6)"),
      number("noise.scale", "1", from(0, 100), &Scenario::noise, &NoiseSettings::scale,
             "factor on the rms of all noise", "0: no noise"),
  };
}

std::vector<Key> run_keys() {
  constexpr auto run = &Scenario::simulation;
  constexpr auto stop = &Scenario::stop;
  return {
      number("simulation.sample_rate_hz", "Hz", from(2e5, 2e7), run,
             &SimulationSettings::sample_rate_hz, "sample rate of the light"),
      whole("simulation.warmup_messages", "1", from(0, 100), run,
            &SimulationSettings::warmup_messages, "messages sent before counting starts",
            "they settle the gain control"),
      whole("simulation.seed", "1", from(0, largest_whole), run, &SimulationSettings::seed,
            "seed of all randomness"),
      whole("stop.max_frames", "1", from(1, 1e12), stop, &StopSettings::max_frames,
            "messages after which a point ends"),
      whole("stop.max_frame_errors", "1", from(0, 1e12), stop, &StopSettings::max_frame_errors,
            "lost messages after which a point ends", "0: no such limit"),
  };
}

std::vector<Key> make_scenario_keys() {
  std::vector<Key> all{title_key()};
  for (const auto& group : {device_keys(), led_settings_keys(), receiver_keys(),
                            module_override_keys(), surroundings_keys(), run_keys()})
    all.insert(all.end(), group.begin(), group.end());
  return all;
}

PartNumber<channel::ModuleData> module_number(std::string name, std::string unit, Range range,
                                              double channel::ModuleData::*member,
                                              std::string long_name, std::string note = "") {
  return {{std::move(name), std::move(unit), range, std::move(long_name), std::move(note)},
          member,
          false};
}

template <class... Rest>
PartNumber<channel::ModuleData> printed(Rest&&... rest) {
  auto row = module_number(std::forward<Rest>(rest)...);
  row.required = true;
  return row;
}

std::vector<PartNumber<channel::ModuleData>> threshold_numbers() {
  using M = channel::ModuleData;
  return {
      printed("centre_hz", "Hz", from(1e3, 1e6), &M::centre_hz, "centre of the band-pass"),
      module_number("q", "1", from(0.5, 100), &M::q, "quality factor of the band-pass",
                    "centre over 3 dB width"),
      printed("emin_mw_per_m2", "mW/m2", above(0, 1e4), &M::emin_mw_per_m2,
              "threshold irradiance in the dark", "typical, 30-cycle burst at the centre"),
      module_number("emin_width_cycles", "cycle", from(-20, 20), &M::emin_width_cycles,
                    "output less input width at the threshold"),
      printed("emax_w_per_m2", "W/m2", above(0, 1e4), &M::emax_w_per_m2,
              "largest irradiance that still works"),
      module_number("comparator_hold_cycles", "cycle", from(0, 20), &M::comparator_hold_cycles,
                    "time that the comparator holds a cycle's peak"),
      module_number("integrator_cycles", "cycle", from(1, 100), &M::integrator_cycles,
                    "length of the integrator"),
      module_number("atc_fraction", "1", from(0, 0.95), &M::atc_fraction,
                    "threshold as a fraction of the signal's peak", "0: a fixed threshold"),
      module_number("atc_release_ms", "ms", above(0, 1e4), &M::atc_release_ms,
                    "time constant with which that threshold falls"),
  };
}

std::vector<PartNumber<channel::ModuleData>> agc_numbers() {
  using M = channel::ModuleData;
  return {
      module_number("agc_attack_db_per_ms", "dB/ms", from(0, 10), &M::agc_attack_db_per_ms,
                    "rate at which the gain falls", "0: a part without AGC"),
      printed("agc_max_duty", "1", above(0, 1), &M::agc_max_duty,
              "largest lit fraction of long bursts that the AGC tolerates"),
      printed("agc_long_burst_cycles", "cycle", above(0, 1e4), &M::agc_long_burst_cycles,
              "length from which a burst is a long one"),
      printed("agc_min_gap_cycles", "cycle", from(0, 1e4), &M::agc_min_gap_cycles,
              "shortest gap after a short burst"),
      module_number("agc_margin_db", "dB", from(0, 40), &M::agc_margin_db,
                    "signal over threshold that the AGC aims at"),
      module_number("agc_range_db", "dB", from(0, 200), &M::agc_range_db,
                    "largest fall of the gain"),
  };
}

std::vector<PartNumber<channel::ModuleData>> front_end_numbers() {
  using M = channel::ModuleData;
  return {
      module_number("aperture_mm2", "mm2", above(0, 1e4), &M::aperture_mm2,
                    "effective area, lens included"),
      module_number("responsivity_a_per_w", "A/W", above(0, 1), &M::responsivity_a_per_w,
                    "responsivity of the photodiode at 940 nm"),
      module_number("feedback_ohm", "Ohm", above(0, 1e9), &M::feedback_ohm,
                    "feedback resistance of the first amplifier"),
      module_number("temperature_k", "K", from(200, 400), &M::temperature_k,
                    "temperature of the part"),
      module_number("ambient_k", "1", from(0, 100), &M::ambient_k,
                    "growth of the threshold with ambient light",
                    "Emin^2 + k E (1 + E/Es), Emin in mW/m2, E in W/m2"),
      module_number("ambient_es_w_per_m2", "W/m2", above(0, 1e6), &M::ambient_es_w_per_m2,
                    "ambient irradiance Es of that law"),
  };
}

PartKeys<channel::ModuleData> make_module_keys() {
  PartKeys<channel::ModuleData> keys{"module", "modules", {}, {}};
  for (const auto& group : {threshold_numbers(), agc_numbers(), front_end_numbers()})
    keys.numbers.insert(keys.numbers.end(), group.begin(), group.end());
  keys.curves = {{"directivity",
                  "relative distance of detection off axis; its square is the response",
                  {"degrees", "degree", from(0, 90), "angle off axis", ""},
                  {"relative_distance", "1", from(0, 1.5), "relative distance", ""},
                  &channel::ModuleData::directivity,
                  false}};
  return keys;
}

PartKeys<channel::EmitterData> make_led_keys() {
  using E = channel::EmitterData;
  return {"LED",
          "leds",
          {},
          {{"intensity",
            "radiant intensity on axis against the current",
            {"ma", "mA", above(0, 1e5), "current", ""},
            {"mw_per_sr", "mW/sr", above(0, 1e6), "radiant intensity", ""},
            &E::intensity_mw_per_sr,
            true},
           {"pattern",
            "relative intensity against the angle off axis",
            {"degrees", "degree", from(0, 90), "angle off axis", ""},
            {"relative_intensity", "1", from(0, 1.5), "relative intensity", ""},
            &E::pattern,
            true}}};
}

/// Levenshtein distance, case aside.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0U);
  for (const char ca : a) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const bool same = std::tolower(static_cast<unsigned char>(ca)) ==
                        std::tolower(static_cast<unsigned char>(b[j]));
      const std::size_t change = diagonal + (same ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({change, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

/// Edit distance, except that a name cut short, as by a forgotten unit, is only one slip.
std::size_t slips(const std::string& name, const std::string& candidate) {
  return candidate.starts_with(name) ? 1 : edit_distance(name, candidate);
}

std::size_t unlikeness(const std::string& name, const std::string& candidate) {
  const std::size_t dot = candidate.find('.');
  if (dot == std::string::npos) return slips(name, candidate);
  return std::min(slips(name, candidate), 1 + slips(name, candidate.substr(dot + 1)));
}

std::string violation(const Range& range, double value) {
  if (value > range.high) return fmt::format("at most {}", range.high);
  return fmt::format("{} {}", range.low_open ? "above" : "at least", range.low);
}

std::string with_unit(const std::string& text, const std::string& unit) {
  return unit.empty() || unit == "1" ? text : text + " " + unit;
}

bool is_control(char c) { return (c >= 0 && c < ' ') || c == '\x7f'; }
bool is_wire_character(char c) { return c >= ' ' && c <= '~'; }

void check_message(const std::string& value, const std::string& problem) {
  if (value.size() > longest_message)
    throw bad_input(problem,
                    fmt::format("a message has at most {} characters, this one {}", longest_message,
                                value.size()),
                    "shorten it");
  if (!std::ranges::all_of(value, is_wire_character))
    throw bad_input(problem, "a message is printable ASCII, from space to ~",
                    "remove the other characters");
}

void check_choice(const Key& key, const std::string& value, const std::string& problem) {
  if (std::ranges::find(key.choices, value) != key.choices.end()) return;
  throw bad_input(problem, "the " + key.facts.long_name + " is one of a list",
                  fmt::format("use {}", fmt::join(key.choices, " or ")));
}

void check_title(const std::string& value, const std::string& problem) {
  if (std::ranges::any_of(value, is_control))
    throw bad_input(problem, "a text is one line without control characters", "remove them");
}

std::string default_of(const Key& key) {
  if (key.name().starts_with("module.")) return "from the part";
  Scenario defaults;
  if (key.is_number()) return fmt::format("{}", key.number(defaults));
  const std::string& value = key.text(defaults);
  return value.empty() ? "empty" : "`" + value + "`";
}

std::string allowed(const Key& key) {
  switch (key.facts.type) {
    case KeyType::number:
      return in_words(key.facts.range);
    case KeyType::whole_number:
      return "whole, " + in_words(key.facts.range);
    case KeyType::text:
      return "text";
    case KeyType::message:
      return fmt::format("printable ASCII, up to {}", longest_message);
    case KeyType::choice:
      return fmt::format("`{}`", fmt::join(key.choices, "` or `"));
    case KeyType::part:
      return "a part's name";
  }
  return "";
}

std::string table_row(const KeyFacts& facts, const std::string& name, const std::string& standard,
                      const std::string& range) {
  return fmt::format("| `{}` | {} | {} | {} | {}{}{} |\n", name,
                     facts.unit.empty() ? "-" : facts.unit, standard, range, facts.long_name,
                     facts.note.empty() ? "" : "; ", facts.note);
}

std::string table_head(const std::string& heading) {
  return fmt::format(
      "\n### {}\n\n| key | unit | default | range | meaning |\n|---|---|---|---|---|\n", heading);
}

std::string scenario_tables() {
  std::string out, group = "none";
  for (const Key& key : scenario_keys()) {
    const std::size_t dot = key.name().find('.');
    const std::string table = dot == std::string::npos ? "" : key.name().substr(0, dot);
    if (table != group) out += table_head(table.empty() ? "Top of the file" : "`[" + table + "]`");
    group = table;
    out += table_row(key.facts, key.name().substr(table.empty() ? 0 : dot + 1), default_of(key),
                     allowed(key));
  }
  return out;
}

template <class Part>
std::string part_table(const PartKeys<Part>& keys, const std::string& heading) {
  std::string out = table_head(heading);
  for (const auto& n : keys.numbers)
    out += table_row(n.facts, n.facts.name,
                     n.required ? "required" : fmt::format("{}", Part{}.*n.member),
                     in_words(n.facts.range));
  for (const auto& c : keys.curves)
    for (const KeyFacts* axis : {&c.x, &c.y}) {
      KeyFacts facts = *axis;
      facts.note = c.long_name;
      out += table_row(facts, c.name + "." + facts.name, c.required ? "required" : "none",
                       "list, " + in_words(facts.range));
    }
  return out;
}

}  // namespace

bool Range::contains(double value) const {
  return (low_open ? value > low : value >= low) && value <= high;
}

const PartKeys<channel::ModuleData>& module_keys() {
  static const auto keys = make_module_keys();
  return keys;
}

const PartKeys<channel::EmitterData>& led_keys() {
  static const auto keys = make_led_keys();
  return keys;
}

const std::vector<Key>& scenario_keys() {
  static const std::vector<Key> keys = make_scenario_keys();
  return keys;
}

const Key* find_key(const std::string& name) {
  const auto& keys = scenario_keys();
  const auto at = std::ranges::find(keys, name, &Key::name);
  return at == keys.end() ? nullptr : &*at;
}

std::string nearest(const std::string& name, const std::vector<std::string>& candidates) {
  const auto likeness = [&](const std::string& c) { return unlikeness(name, c); };
  const auto best = std::ranges::min_element(candidates, {}, likeness);
  return best == candidates.end() ? "" : *best;
}

Failure bad_input(const std::string& problem, const std::string& why,
                  const std::string& suggestion) {
  std::string line = fmt::format("{} ({}) {}", problem, why, suggestion);
  std::ranges::replace_if(line, is_control, '?');
  return {ExitCode::bad_input, line};
}

std::string in_words(const Range& range) {
  return range.low_open ? fmt::format("above {} up to {}", range.low, range.high)
                        : fmt::format("{} to {}", range.low, range.high);
}

void check_number(const KeyFacts& facts, double value, const std::string& place) {
  const std::string problem = fmt::format("{} = {} {}", facts.name, value, place);
  const bool whole_number = facts.type == KeyType::whole_number;
  const std::string remedy =
      fmt::format("use a {} {}", whole_number ? "whole number" : "value", in_words(facts.range));
  if (!std::isfinite(value)) throw bad_input(problem, "not a finite number", remedy);
  if (whole_number && value != std::floor(value))
    throw bad_input(problem, facts.long_name + ": only whole numbers", remedy);
  if (!facts.range.contains(value))
    throw bad_input(problem,
                    fmt::format("{} must be {}", facts.long_name,
                                with_unit(violation(facts.range, value), facts.unit)),
                    remedy);
}

void check_text(const Key& key, const std::string& value, const std::string& place) {
  constexpr std::size_t shown = 60;
  const std::string shown_value = value.size() > shown ? value.substr(0, shown) + "..." : value;
  const std::string problem = fmt::format("{} = \"{}\" {}", key.name(), shown_value, place);
  if (key.facts.type == KeyType::message) return check_message(value, problem);
  if (key.facts.type == KeyType::choice) return check_choice(key, value, problem);
  check_title(value, problem);
}

std::string key_reference() {
  return scenario_tables() + part_table(module_keys(), "`modules/NAME.toml`") +
         part_table(led_keys(), "`leds/NAME.toml`");
}

}  // namespace sim
