#include "sim/serial/serial_port.hpp"

#include <fcntl.h>
#include <sys/file.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "sim/failure.hpp"
#include "sim/serial/raw_mode.hpp"

namespace sim {
namespace {

Descriptor open_device(const std::filesystem::path& device) {
  Descriptor opened(::open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (opened.is_open()) return opened;
  throw Failure(ExitCode::environment, "cannot open " + device.string() + " (" +
                                           std::strerror(errno) +
                                           ") plug it in, or check its name and permissions");
}

bool port_is_for_later() { return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR; }

}  // namespace

SerialPort::SerialPort(std::filesystem::path device, double baud)
    : device_(std::move(device)), open_(open_device(device_)) {
  remember();
  claim();
  make_raw(baud);
}

SerialPort::~SerialPort() { ::tcsetattr(open_.get(), TCSANOW, &before_); }

void SerialPort::remember() {
  if (::tcgetattr(open_.get(), &before_) == 0) return;
  throw bad_input("cannot use " + name(), "it is no serial device",
                  "give one such as /dev/ttyUSB0, or the end of a pseudo-terminal");
}

void SerialPort::claim() const {
  if (::flock(open_.get(), LOCK_EX | LOCK_NB) == 0) return;
  throw Failure(ExitCode::environment, "cannot use " + name() +
                                           " (another program has locked it) end that, or give "
                                           "another device");
}

/// tcsetattr succeeds if it could do anything at all, so the speed is looked at.
void SerialPort::make_raw(double baud) const {
  const termios wanted = raw_mode(before_, baud);
  termios now{};
  ::tcsetattr(open_.get(), TCSANOW, &wanted);
  if (::tcgetattr(open_.get(), &now) == 0 && ::cfgetospeed(&now) == ::cfgetospeed(&wanted) &&
      now.c_lflag == wanted.c_lflag) {
    ::tcflush(open_.get(), TCIFLUSH);
    return;
  }
  ::tcsetattr(open_.get(), TCSANOW, &before_);
  throw Failure(ExitCode::environment,
                "cannot use " + name() + " (it refuses this speed) choose another with --baud");
}

protocol::Bytes SerialPort::read() {
  std::array<std::uint8_t, 4096> buffer{};
  const ssize_t n = ::read(open_.get(), buffer.data(), buffer.size());
  if (n > 0) return {buffer.begin(), buffer.begin() + n};
  if (n < 0 && port_is_for_later()) return {};
  vanished();
}

std::size_t SerialPort::write(std::span<const std::uint8_t> bytes) {
  const ssize_t n = ::write(open_.get(), bytes.data(), bytes.size());
  if (n >= 0) return static_cast<std::size_t>(n);
  if (port_is_for_later()) return 0;
  vanished();
}

void SerialPort::vanished() const {
  throw Failure(ExitCode::environment,
                name() +
                    " vanished (it was unplugged, or its other end closed) plug it in and "
                    "start again");
}

}  // namespace sim
