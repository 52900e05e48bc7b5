#pragma once
// A delimited stream as a capture for somebody's decoder: the formats that a command may ask for,
// by the word in braces which stands for the file: "sigrok-cli -i {sr} ...".
#include <span>
#include <string>

#include "sim/check/delimited_stream.hpp"

namespace sim {

struct LineCapture {
  const char* name;    // "vcd"
  const char* ending;  // of its file
  std::string (*bytes)(const DelimitedStream&);
};

/// edges: a line a change, "1234567 0": microseconds and the level from then on; the first line is
/// the level at 0, the last one the end.
std::span<const LineCapture> line_captures();

}  // namespace sim
