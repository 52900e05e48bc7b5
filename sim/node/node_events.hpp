#pragma once
// Events of a node as JSON lines on stdout, each as soon as it happens: "time_s" since the start,
// "event", and what belongs to it.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "dsp/units.hpp"
#include "protocol/shared_node.hpp"
#include "sim/node/node_file.hpp"

namespace sim {

/// Bytes and messages of a node's port, beside what the node itself counts.
struct PortCounts {
  std::uint64_t bytes_received = 0, bytes_sent = 0;
  std::uint64_t dropped = 0;  // messages that the port did not take in time
};

void print_ready(dsp::Seconds now, const std::string& port, const NodeFile& file);

/// A variable with its value: "changed" or "answered".
void print_value(dsp::Seconds now, std::string_view event,
                 const protocol::SharedVariable& variable);

/// A query that nobody answered in time.
void print_timed_out(dsp::Seconds now, const std::string& name);

/// What happens to the port: "connected" and "disconnected", as far as it can tell, and "blocked":
/// it takes no more bytes, so messages are dropped.
void print_port_event(dsp::Seconds now, std::string_view event);

/// A message with this node's own address as its source.
void print_own_address(dsp::Seconds now, const std::string& message);

/// What a message was counted as, beside "accepted", between two looks at the counts.
void print_misfits(dsp::Seconds now, const protocol::SharedNodeCounts& before,
                   const protocol::SharedNodeCounts& after, const std::string& message);

/// Why it ended, and all counts.
void print_end(dsp::Seconds now, std::string_view reason, const protocol::SharedNodeCounts& node,
               const PortCounts& port);

}  // namespace sim
