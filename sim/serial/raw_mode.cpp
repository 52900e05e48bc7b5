#include "sim/serial/raw_mode.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/failure.hpp"

namespace sim {
namespace {

struct Speed {
  double baud;
  speed_t constant;
};

constexpr std::array<Speed, 30> speeds{
    {{50, B50},           {75, B75},           {110, B110},         {134, B134},
     {150, B150},         {200, B200},         {300, B300},         {600, B600},
     {1200, B1200},       {1800, B1800},       {2400, B2400},       {4800, B4800},
     {9600, B9600},       {19200, B19200},     {38400, B38400},     {57600, B57600},
     {115200, B115200},   {230400, B230400},   {460800, B460800},   {500000, B500000},
     {576000, B576000},   {921600, B921600},   {1000000, B1000000}, {1152000, B1152000},
     {1500000, B1500000}, {2000000, B2000000}, {2500000, B2500000}, {3000000, B3000000},
     {3500000, B3500000}, {4000000, B4000000}}};

const Speed& nearest_speed(double baud) {
  const auto ratio = [&](const Speed& s) { return std::abs(std::log(s.baud / baud)); };
  return *std::ranges::min_element(speeds, {}, ratio);
}

}  // namespace

bool is_standard_speed(double baud) {
  return std::ranges::find(speeds, baud, &Speed::baud) != speeds.end();
}

void check_speed(double baud, const std::string& place) {
  if (is_standard_speed(baud)) return;
  const std::string remedy =
      baud > 0 ? fmt::format("the nearest is {}", nearest_speed(baud).baud) : "such as 600 or 9600";
  throw bad_input(fmt::format("baud = {} {}", baud, place), "no standard speed of serial ports",
                  remedy);
}

termios raw_mode(termios settings, double baud) {
  ::cfmakeraw(&settings);
  settings.c_cflag |= static_cast<tcflag_t>(CREAD | CLOCAL);
  settings.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);
  settings.c_iflag &= ~static_cast<tcflag_t>(IXOFF | IXANY);
  settings.c_cc[VMIN] = 1;  // so that no byte is an error, and none at all the end
  settings.c_cc[VTIME] = 0;
  const speed_t constant = nearest_speed(baud).constant;
  ::cfsetispeed(&settings, constant);
  ::cfsetospeed(&settings, constant);
  return settings;
}

}  // namespace sim
