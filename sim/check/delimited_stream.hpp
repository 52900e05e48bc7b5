#pragma once
// Many frames on one wire, for decoders that are programs and say nothing but what they decoded:
// before each frame, and behind the last, stands a marker, an undisturbed message with the frame's
// number. What comes out between two markers was made of the frame between them.
//
//   "\nMARK #0 26\n"  pin of trial 0: 100 ms of its pause, the counted message, 20 ms
//   "\nMARK #1 27\n"  pin of trial 1: ...
//
// Its newline ends what the frame before left unended, so every frame is met by a decoder that
// waits for a line to begin: other than in a run, no frame is lost for the one before.
#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dsp/logic_trace.hpp"
#include "sim/check/frame_outcome.hpp"
#include "sim/link/link.hpp"

namespace sim {

/// A link, and the bit rate that its decoders are told: receiver_baud has the clock's error too.
struct JudgedLink {
  Link link;
  dsp::Hertz baud;
};

/// A frame's piece of the wire, and where a pin that is only late would have its characters.
struct FrameOnLine {
  dsp::Seconds from, to;
  std::vector<dsp::Seconds> byte_start;
  dsp::Seconds bit;
  std::uint64_t light = 0;  // a hash of the piece
};

struct DelimitedStream {
  dsp::LogicTrace wire;  // times are those of the receiver's clock
  dsp::Hertz baud;
  std::uint32_t first = 0;  // trial
  std::vector<FrameOnLine> frames;
  const protocol::UartReceiver* uart = nullptr;  // of the scenario
};

/// Trials first ... first + n - 1. Worth nothing once `*stop` is true.
DelimitedStream hear_delimited(const JudgedLink& judged, std::uint32_t first, int n,
                               const std::atomic<bool>* stop = nullptr);

/// A line of one trial's whole pin, between markers of that trial and the next.
DelimitedStream mark(const JudgedLink& judged, std::uint32_t trial, const dsp::LogicTrace& pin);

/// The device message of a marker.
std::string marker(std::uint32_t number);
/// Whether a device message could be one.
bool is_like_marker(const std::string& message);

/// What became of trials first ... first + n - 1, of which each sent `message`, by what a decoder
/// accepted of their line, in its order.
std::vector<FrameOutcome> outcomes_between_markers(const std::vector<std::string>& accepted,
                                                   const std::string& message, std::uint32_t first,
                                                   std::size_t n);

/// What a decoder accepted of such a line between its markers; nothing if it lost one of them.
std::optional<std::vector<std::string>> accepted_between_markers(
    const std::vector<std::string>& accepted, std::uint32_t trial);

}  // namespace sim
