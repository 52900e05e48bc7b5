#pragma once
// SerialPort: a serial device or one end of a pseudo-terminal, in raw mode, for one process alone
// (flock, as other terminal programs do). What its settings were before, they are again afterwards.
#include <termios.h>

#include <filesystem>

#include "sim/serial/descriptor.hpp"
#include "sim/serial/port.hpp"

namespace sim {

class SerialPort final : public Port {
 public:
  /// Throws Failure: bad_input for what is no serial device, environment for what cannot be opened,
  /// is in use, or refuses this speed, which must be a standard one.
  SerialPort(std::filesystem::path device, double baud);
  ~SerialPort() override;

  std::string name() const override { return device_.string(); }
  int descriptor() override { return open_.get(); }
  protocol::Bytes read() override;
  std::size_t write(std::span<const std::uint8_t> bytes) override;

 private:
  void claim() const;
  void remember();
  void make_raw(double baud) const;
  [[noreturn]] void vanished() const;

  std::filesystem::path device_;
  Descriptor open_;
  termios before_{};
};

}  // namespace sim
