#pragma once
// The few cycles of the carrier that tell most of a trial: where the first misread bit goes wrong.
#include <string>

#include "sim/trace/traced_message.hpp"

namespace sim {

struct CloseUp {
  double edge_s = 0;            // since the trial began
  double from_s = 0, to_s = 0;  // about it
  std::string edge;             // which it is
};

/// Of the first character that was not read as it was sent, or else of the first, which must be
/// there: in its first bit that is wrong at the pin the pin's last edge before it was read, or
/// where it has none, the bit's beginning. Where no bit is wrong, the beginning of the start bit.
CloseUp close_up_of(const TracedTrial& trial, const TracedMessage& message);

}  // namespace sim
