#pragma once
// What a scenario says of presence and of location by intensity. LED, floor, range and ambient
// light are those of a link; lists are texts: "1,2,5".
#include <string>

#include "sim/scenario/experiment_kind.hpp"
#include "sim/scenario/placed_device.hpp"

namespace sim {

struct PresenceScenario {
  std::string detector = "goertzel";  // of sim::detector_names()
  double tuned_hz = 59e3;
  double window_ms = 10;
  double reference_ms = 10;
  double keyed = 0;  // a flag
  std::string false_alarm = "0.001,0.01,0.1";
  double trials = 1000;  // whole number
  std::string photodiode = "BPW34";
  double feedback_ohm = 1e6;
  double adc_rate_hz = 200e3;
  double adc_bits = 12;  // whole number
  double adc_full_scale_v = 5;
  double aperture = 1;
};

struct LocationScenario {
  std::string x_m = "0,3,3,0", y_m = "0,0,2,2", heading_deg = "35,145,215,-35";
  std::string photodiode = "BPW34";
  double device_x_m = 1.4, device_y_m = 0.5;
  double device_yaw_deg = unset;  // as bright to all sides
  double relative_sigma = 0.03;
  double sigma_mw_per_m2 = 0.1;
  double bearing_sigma_deg = unset;  // no bearings
  double intensity_unknown = 0;      // a flag
  std::string area_m{};              // x from, to, y from, to; empty: what the light allows
  double trials = 1000;              // whole number
};

/// What a scenario may say of presence and of location, with the keys of [presence] and [location].
extern const ExperimentKind presence_kind, location_kind;

}  // namespace sim
