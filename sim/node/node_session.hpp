#pragma once
// NodeSession: a node at a port in real time: bytes and instructions in, bytes and events out,
// until its time is over, a signal comes or the port is gone. Nothing in it waits but for the next
// of these.
#include <atomic>
#include <chrono>
#include <string>

#include "dsp/units.hpp"
#include "protocol/shared_node.hpp"
#include "sim/failure.hpp"
#include "sim/node/node_events.hpp"
#include "sim/node/node_file.hpp"
#include "sim/node/paced_output.hpp"
#include "sim/serial/line_input.hpp"
#include "sim/serial/line_output.hpp"
#include "sim/serial/port.hpp"

namespace sim {

class NodeSession {
 public:
  /// Instructions come from stdin; when that ends, the node goes on.
  NodeSession(const NodeFile& file, Port& port, LineOutput& events);

  /// Done after so long, or interrupted by the flag. Says how it ended in any case, and what the
  /// node counted; what the port throws goes on from here.
  ExitCode run(dsp::Seconds duration, const std::atomic<bool>& stopping);

 private:
  dsp::Seconds now() const;
  void step(dsp::Seconds end);
  void wait(dsp::Seconds until);
  /// The port's descriptor; says so if somebody came to its other end, who gets a full set at once,
  /// or left.
  int watched_port();
  void hear(dsp::Seconds at);
  void take(std::uint8_t byte, dsp::Seconds at);
  void warn_of_own_address(dsp::Seconds at, const std::string& message);
  void heed_instructions();
  /// Before the node sees this time: it would give up too, and say nothing.
  void give_up(dsp::Seconds at);
  void transmit(dsp::Seconds at);
  void drop(dsp::Seconds at);
  void send(dsp::Seconds at);

  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  NodeFile file_;
  Port& port_;
  protocol::SharedNode node_;
  LineInput input_;
  PacedOutput output_;
  NodeEvents events_;
  PortCounts counts_;
  dsp::Seconds next_transmission_{};
  bool can_hear_ = false, can_read_ = false;  // by the last poll
  bool connected_, blocked_ = false, warned_ = false;
};

}  // namespace sim
