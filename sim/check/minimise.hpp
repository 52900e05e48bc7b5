#pragma once
// The least that a decoder does not survive: of all that noise and the module did to a frame's
// bits, a smallest part which still makes the candidate lose it, and the baseline not. By delta
// debugging (Zeller & Hildebrandt, IEEE TSE 28 (2002) 183, ddmin): no bit of the part can be
// mended without the candidate hearing the frame, or the baseline losing it too.
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sim/check/one_frame.hpp"

namespace sim {

/// A piece of the wire: a bit, or what is before and behind the message.
struct WirePiece {
  dsp::Seconds from, to;
  bool sent;  // its level, had nothing happened
};

struct Minimised {
  OneFrame frame;                      // with nothing but these disturbed
  std::vector<WirePiece> pieces;       // of the frame, in order
  std::vector<std::size_t> disturbed;  // of pieces: what is left
  std::size_t at_first = 0;            // how many were disturbed
  bool accepts_wrongly = false;        // what the candidate does; else it loses the frame
};

/// Nothing where the candidate does not lose the frame, or the baseline does; of a candidate that
/// accepts what was not sent, where it does not, or the baseline does, too.
std::optional<Minimised> minimise(const OneFrame& frame, const Decoder& candidate,
                                  const Decoder& baseline);

/// Which bits these are, a line each.
std::string disturbed_text(const Minimised& least, const Decoder& candidate,
                           const Decoder& baseline);
/// The wire as a test vector in C.
std::string test_vector(const Minimised& least);

}  // namespace sim
