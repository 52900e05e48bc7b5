#pragma once
// Port: where bytes go to and come from. Neither reading nor writing waits. A port that is
// gone for good throws Failure(environment), one line.
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "protocol/uart.hpp"

namespace sim {

class Port {
 public:
  Port() = default;
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;
  virtual ~Port() = default;

  /// What it is called by people.
  virtual std::string name() const = 0;
  /// To be polled for bytes to read; -1 while there is nobody who could send any.
  virtual int descriptor() = 0;
  /// What has come so far, or a part of it.
  virtual protocol::Bytes read() = 0;
  /// How many of the bytes were taken: those in front.
  virtual std::size_t write(std::span<const std::uint8_t> bytes) = 0;
};

}  // namespace sim
