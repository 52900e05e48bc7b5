#pragma once
// Instructions: lines that tell a node what to do while it runs.
//   Name=value                      a new value of an outbound variable; spaces belong to the value
//   ?Name                           asks the peer for an inbound variable
//   {"set": {"Name": "value"}}, {"ask": "Name"}    the same as JSON, for names that look otherwise
#include <cstddef>
#include <string>

#include "protocol/shared_node.hpp"

namespace sim {

inline constexpr std::size_t longest_instruction = std::size_t{1} << 16U;

/// Throws bad_input, one line, for what the node cannot do, and then does nothing of it; an empty
/// line is nothing to do.
void obey(protocol::SharedNode& node, const std::string& line);

}  // namespace sim
