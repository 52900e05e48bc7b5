#pragma once
// Scenario: one experiment as its TOML file says it. Every field is a key of sim/scenario/keys.cpp
// or, in `settings`, of the folder of an experiment, which gives its name, unit, bounds and
// meaning; scenarios/KEYS.md prints them. Loading turns text into a base and its sweep, all of
// whose points hold before any is run.
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "channel/emitter.hpp"
#include "channel/floor.hpp"
#include "channel/photodiode.hpp"
#include "channel/receiver_module.hpp"
#include "sim/scenario/axis.hpp"
#include "sim/scenario/experiment_settings.hpp"
#include "sim/scenario/placed_device.hpp"

namespace sim {

struct DeviceSettings {
  std::string message = "IND 011111 OK";
  double baud = 600;
  double clock_error_ppm = 0;
  double start_jitter_us = 0;
  double interval_min_ms = 100, interval_max_ms = 900;
  double carrier_hz = 59000;
  double carrier_error_ppm = 0;
  double carrier_duty = 0.5;
  double pulse_us = 0;  // of light, for each zero bit; 0: the whole bit
};

struct LedSettings {
  std::string part = "TSAL6200";
  double current_ma = 100;
  double height_mm = 10;
  double temperature_c = 25;
  double yaw_deg = 0, elevation_deg = 0;
};

struct FloorSettings {
  std::string part = "indoor";
};

/// The value of receiver.population of which a trial draws what nobody printed, too.
inline constexpr double population_with_constants = 2;

struct ReceiverSettings {
  std::string module = "TSOP4856";
  double ebn0_db = unset;  // the geometry then sets the light
  double range_m = 1;
  double bearing_deg = 0;
  double height_mm = 10;
  double yaw_deg = 0, tilt_deg = 0;
  double temperature_c = 25;
  double supply_v = unset;  // the part's typical
  double supply_ripple_mv = 0;
  std::string supply_ripple_at = "f0";  // of channel::ripple_frequencies()
  double unit = 0;                      // whole number: of the units drawn; 0: the part as it is
  double population = 0;                // another unit a trial; 0: none
};

struct UartSettings {
  std::string receiver = "atmega";  // of protocol::uart_receivers()
  double clock_error_ppm = 0;
  double monostable = 1;  // makes whole bits of short pulses before the UART
};

struct AmbientSettings {
  double irradiance_w_per_m2 = 0.6;
  double daylight_lux = 0, tungsten_lux = 0;  // add to it
};

/// Another light. Which numbers mean something, and their defaults, depend on the kind:
/// sim/scenario/disturbance_keys.hpp.
struct DisturbanceSettings {
  std::string kind{};
  double irradiance_w_per_m2 = 0;  // mean of a lamp, peak of an on/off wave
  // Lamps.
  double lux = 0;  // of those that are rated so, in place of the irradiance
  double mains_hz = 50, modulation_depth = 0;
  double ballast_hz = 0, ballast_db_per_decade = 20;
  double frequency_hz = 0, duty = 0.5;
  // Keyed carriers.
  double carrier_hz = 0, carrier_duty = 0.5;
  double leader_ms = 0, leader_gap_ms = 0, burst_ms = 0, gap_min_ms = 0, gap_max_ms = 0;
  double bursts = 0;  // whole number
  double repetition_ms = 0;
  std::string message = "IND 111110 OK";
  double baud = 0, interval_min_ms = 0, interval_max_ms = 0;
  double variables = 0;  // whole number
};

struct NoiseSettings {
  double scale = 1;  // of the rms; 0 turns all noise off
};

struct SimulationSettings {
  std::string fidelity = "waveform";   // of sim::fidelities()
  std::string method = "brute-force";  // of sim::methods()
  double sample_rate_hz = 600e3;
  double warmup_messages = 4;  // whole number
  double seed = 1;             // whole number
};

struct StopSettings {
  double max_frames = 1000;           // whole number
  double max_frame_errors = 100;      // whole number; 0: no such limit
  double rel_ci = 0, target_flr = 0;  // 0: no such rule
};

struct Scenario {
  std::string title;
  std::string experiment = "link";  // of sim::experiment_kinds()
  DeviceSettings device;
  LedSettings led;
  ReceiverSettings receiver;
  channel::ModuleData module;    // from the part's file, then [module] keys override
  channel::EmitterData emitter;  // from the part's file
  FloorSettings floor_settings;
  channel::Floor floor;  // from the part's file, then [floor] keys override
  UartSettings uart;
  AmbientSettings ambient;
  std::map<std::string, DisturbanceSettings> disturbances;  // by their names
  NoiseSettings noise;
  SimulationSettings simulation;
  StopSettings stop;
  PathSettings path;
  ExperimentSettings settings;
  channel::PhotodiodeData photodiode;  // from the part's file, in experiments that have one
  std::map<std::string, PlacedDevice> devices;  // by their names
};

/// Where each key was given: "in x.toml:14".
using SourceLocations = std::map<std::string, std::string>;

/// A scenario's file, its sweep and what the command line changed.
struct LoadedScenario {
  Scenario base;  // everything but the sweep
  /// Enough to repeat the run anywhere: the whole file, and behind it a [[part]] table for each
  /// part that it does not carry yet and an [[override]] table for each --set and for the names
  /// behind each "*".
  std::string text;
  std::filesystem::path path;
  std::vector<Axis> sweep;  // in the order of the file, then of --set
  SourceLocations places;
  /// For each axis: of parts, the base with each of them; of others, nothing.
  std::vector<std::vector<Scenario>> variants;
};

}  // namespace sim
