#pragma once
// What a scenario says of a receiver that listens to a line for hours. Keys:
// sim/listening/listening_keys.cpp. Receiver, device and light are those of a link.
#include <string>

namespace sim {

struct ListeningSettings {
  double device_sends = 0;   // a flag
  std::string air = "none";  // or one of sim::disturbance_kinds()
  double duration_s = 60;
  double runs = 60;  // whole number
};

}  // namespace sim
