#pragma once
// What a scenario says of devices that send, and of a receiver that moves past them. Keys:
// sim/scenario/placed_device_keys.cpp.
#include <limits>
#include <string>

#include "channel/emitter.hpp"

namespace sim {

inline constexpr double unset = std::numeric_limits<double>::quiet_NaN();

/// A [devices.NAME] table: one device, or `count` of a kind. Lists are texts: "1,2,5", or a message
/// a line.
struct PlacedDevice {
  double x_m = 0, y_m = 0;
  double count = 1;                        // whole number
  double spread_x_m = 0, spread_y_m = 0;   // places uniform in a rectangle of these sides
  double height_mm = unset;                // as the LED's
  double yaw_deg = 0, yaw_spread_deg = 0;  // uniform around it
  std::string led{};                       // empty: the scenario's
  channel::EmitterData emitter{};          // of that part
  double leds = 1;                         // whole number; in even steps around
  double current_ma = unset;               // as the LED's
  std::string source = "fixed";            // of sim::message_sources()
  std::string messages = "IND 011111 OK";  // one a line
  double status_hold_s = 10;               // mean
  double interval_min_ms = 100, interval_max_ms = 900;
  std::string intervals_ms{};   // instead of those two, in turn
  std::string interval_file{};  // from which that list is
  double silent_every_s = 0;    // mean; 0: never silent
  double silent_for_s = 5;      // mean
  double carrier_error_ppm = 0, carrier_spread_ppm = 0;
  double clock_error_ppm = 0, clock_spread_ppm = 0;
};

/// A receiver's way. Lists of equal length, or of one number that holds throughout.
struct PathSettings {
  std::string x_m = "0", y_m = "0";
  std::string heading_deg{};  // at each way-point; empty: where it goes
  double speed_m_per_s = 0.3;
  double turn_deg_per_s = 90;
};

}  // namespace sim
