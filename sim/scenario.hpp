#pragma once
// Scenario: one experiment as its TOML file says it. Every field is a key of the table in
// sim/keys.cpp, which gives its name, unit, bounds and meaning; scenarios/README.md prints it.
// Loading turns text into a base and its sweep, all of whose points hold before any is run.
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "channel/emitter.hpp"
#include "channel/floor.hpp"
#include "channel/receiver_module.hpp"
#include "sim/axis.hpp"

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
};

struct LedSettings {
  std::string part = "TSAL6200";
  double current_ma = 100;
  double height_mm = 10;
  double yaw_deg = 0, elevation_deg = 0;
};

struct ReceiverSettings {
  std::string module = "TSOP4856";
  double range_m = 1;
  double bearing_deg = 0;
  double height_mm = 10;
  double yaw_deg = 0, tilt_deg = 0;
};

struct UartSettings {
  std::string receiver = "atmega";  // or "mid-bit"
  double clock_error_ppm = 0;
};

struct AmbientSettings {
  double irradiance_w_per_m2 = 0.6;
};

struct NoiseSettings {
  double scale = 1;  // of the rms; 0 turns all noise off
};

struct SimulationSettings {
  double sample_rate_hz = 600e3;
  double warmup_messages = 4;  // whole number
  double seed = 1;             // whole number
};

struct StopSettings {
  double max_frames = 1000;       // whole number
  double max_frame_errors = 100;  // whole number; 0: no such limit
};

struct Scenario {
  std::string title;
  DeviceSettings device;
  LedSettings led;
  ReceiverSettings receiver;
  channel::ModuleData module;    // from the part's file, then [module] keys override
  channel::EmitterData emitter;  // from the part's file
  channel::Floor floor{.refractive_index = 1.5, .roughness_um = 5, .diffuse_reflectance = 0.3};
  UartSettings uart;
  AmbientSettings ambient;
  NoiseSettings noise;
  SimulationSettings simulation;
  StopSettings stop;
};

/// Where each key was given: "in x.toml:14".
using Places = std::map<std::string, std::string>;

/// A scenario's file, its sweep and what the command line changed.
struct LoadedScenario {
  Scenario base;  // everything but the sweep
  /// Enough to repeat the run anywhere: the whole file, and behind it a [[part]] table for each
  /// part that it does not carry yet and an [[override]] table for each --set.
  std::string text;
  std::filesystem::path path;
  std::vector<Axis> sweep;  // in the order of the file, then of --set
  Places places;
};

/// Load a file. `overrides` are "key=value" as of --set, applied in order after the file's own
/// [[override]] tables; `roots` are folders that hold modules/ and leds/.
LoadedScenario load_scenario(const std::filesystem::path& path,
                             const std::vector<std::string>& overrides,
                             const std::vector<std::filesystem::path>& roots);

/// The same of a text in memory; `path` only names it in messages.
LoadedScenario parse_scenario(const std::string& text, const std::filesystem::path& path,
                              const std::vector<std::string>& overrides,
                              const std::vector<std::filesystem::path>& roots);

}  // namespace sim
