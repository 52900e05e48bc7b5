#pragma once
// NodeEvents: what happens to a node as JSON lines, each as soon as it happens: "time_s" since the
// start, "event", and what belongs to it. Of a reader that stalls nothing here takes notice: what
// finds no room is lost, and "lost" stands in its place.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "dsp/units.hpp"
#include "protocol/shared_node.hpp"
#include "sim/node/node_file.hpp"
#include "sim/serial/line_output.hpp"

namespace sim {

/// Bytes and messages of a node's port, beside what the node itself counts.
struct PortCounts {
  std::uint64_t bytes_received = 0, bytes_sent = 0;
  std::uint64_t dropped = 0;  // messages that the port did not take in time
};

class NodeEvents {
 public:
  /// The reader's end is watched by who made the output.
  explicit NodeEvents(LineOutput& output) : output_(output) {}

  /// Throws Failure(environment) if nothing can be written any more.
  void check() const { output_.check(); }

  void ready(dsp::Seconds now, const std::string& port, const NodeFile& file);
  /// A variable with its value: "changed", "answered" or "answered_late".
  void value(dsp::Seconds now, std::string_view event, const protocol::SharedVariable& variable);
  /// A query that nobody answered in time.
  void timed_out(dsp::Seconds now, const std::string& name);
  /// What happens to the port: "connected" and "disconnected", as far as it can tell, and
  /// "blocked": it takes no more bytes, so messages are dropped.
  void port(dsp::Seconds now, std::string_view event);
  /// A message with this node's own address as its source.
  void own_address(dsp::Seconds now, const std::string& message);
  /// What a message was counted as, beside "accepted", between two looks at the counts.
  void misfits(dsp::Seconds now, const protocol::SharedNodeCounts& before,
               const protocol::SharedNodeCounts& after, const std::string& message);
  /// Why it ended, and all counts. It is said in any case.
  void end(dsp::Seconds now, std::string_view reason, const protocol::SharedNodeCounts& node,
           const PortCounts& port);

 private:
  /// Lost if the output has no room.
  void say(dsp::Seconds now, const std::string& line);
  /// Behind how many were lost before it.
  void say_in_any_case(dsp::Seconds now, const std::string& line);
  void refuse(dsp::Seconds now, std::string_view reason, const std::string& message);

  LineOutput& output_;
  std::uint64_t lost_ = 0, all_lost_ = 0;  // since the last event, and since the start
};

}  // namespace sim
