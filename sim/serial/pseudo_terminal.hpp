#pragma once
// PseudoTerminal: a serial port that exists for as long as this object does, at a name that stays:
// a symbolic link. Another program opens the link as it would a device. While none has it open,
// bytes are lost, as on a line with nobody at its end; so one that comes later gets nothing stale.
#include <filesystem>

#include "sim/serial/descriptor.hpp"
#include "sim/serial/port.hpp"

namespace sim {

class PseudoTerminal final : public Port {
 public:
  /// Throws Failure: bad_input where something else has the link's name, environment where the
  /// machine refuses. Only a link that this kind of object left behind is replaced.
  PseudoTerminal(std::filesystem::path link, double baud);
  ~PseudoTerminal() override;

  std::string name() const override { return link_.string(); }
  int descriptor() override;
  protocol::Bytes read() override;
  std::size_t write(std::span<const std::uint8_t> bytes) override;

 private:
  void make_new() const;
  void make_link() const;
  bool is_left_behind() const;

  std::filesystem::path link_;
  double baud_;
  Descriptor ours_;
  std::filesystem::path theirs_;  // "/dev/pts/5"
  bool used_ = false;             // since it was made as new
};

}  // namespace sim
