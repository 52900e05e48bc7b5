#pragma once
// What `cosys-sim serve` says of its messages: a JSON line each.
#include <cstdint>
#include <string>

#include "sim/serve/line_decoder.hpp"
#include "sim/serve/line_message.hpp"

namespace sim {

/// `bytes_lost`: those that no reader took. `origin` is where on the line its time 0 was.
std::string message_line(const LineMessage& message, dsp::Seconds origin,
                         const LineVerdict& verdict, std::uint64_t bytes_lost);

/// In the place of so many lines that nobody read in time.
std::string lost_lines(std::uint64_t lines);

}  // namespace sim
