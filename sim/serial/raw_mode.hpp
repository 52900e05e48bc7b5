#pragma once
// Raw mode of a terminal line: bytes pass as they are, 8N1, without echo, line editing, signals,
// translation or flow control.
#include <termios.h>

#include <string>

namespace sim {

/// Whether termios has a constant for so many bits per second.
bool is_standard_speed(double baud);

/// Throws bad_input, naming the nearest standard speed, if it is none; `place` says where it is
/// written.
void check_speed(double baud, const std::string& place);

/// These settings made raw, at a standard speed.
termios raw_mode(termios settings, double baud);

}  // namespace sim
