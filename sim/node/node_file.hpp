#pragma once
// NodeFile: one end of a SharedLink as text: who it is, the names of its two lists, in order, and
// values to begin with. Whatever is read here makes a node.
#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "dsp/units.hpp"
#include "protocol/shared_node.hpp"

namespace sim {

struct NodeFile {
  /// An answer takes its turn behind a whole list, which takes seconds at 600 bits per second.
  protocol::SharedNodeSettings settings{.query_timeout = dsp::Seconds(5)};
  std::vector<std::pair<std::size_t, std::string>> values;  // of outbound variables
  dsp::Hertz baud{600};
  dsp::Seconds send_period{0.1};  // between looks at what is to be sent
};

/// Throws bad_input, naming place and remedy, of the first thing that cannot be.
NodeFile parse_node_file(const std::string& text, const std::filesystem::path& path);

/// The node of a file that was read, with its values and its line's pace.
protocol::SharedNode make_node(const NodeFile& file);

}  // namespace sim
