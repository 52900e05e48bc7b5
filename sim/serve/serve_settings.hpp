#pragma once
// ServeSettings: how a line is played.
#include <limits>

#include "dsp/units.hpp"

namespace sim {

struct ServeSettings {
  double speed = 1;                  // of the line's clock to that on the wall
  bool start_at_once = false;        // not when somebody opens the port
  bool drop_framing_errors = false;  // bytes without a stop bit
  dsp::Seconds duration{std::numeric_limits<double>::infinity()};  // on the line's clock
};

}  // namespace sim
