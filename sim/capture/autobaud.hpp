#pragma once
// What a UART line is like, found in a stretch of it: which level is idle, and the bit rate.
//
// The bit is a time T of which nearly all distances from fall to fall are whole multiples and
// nearly all light pulses whole multiples but for one and the same excess of at most 0.35 T
// (pulse-width distortion moves rises against falls, never falls against falls). Several times may
// do, and either level may be idle: each such reading is tried, and what decides is whether the
// characters make sense. Worth most are whole messages (COSYS, SharedLink) with a right checksum;
// then characters without a framing error, and those of text more than others. A reading is worth
// less whose idle level is not that of the longest stretch between two edges, where that is at
// least twice as long as the longest at the other level (8N1 is never at the start bit's level for
// more than nine bits, but idles longer). Of readings that are about as good the one is taken whose
// idle level is that of the longest stretch; then the one of the longest bit. Where no reading
// has a message, standard rates are tried too, as something else may be on the wire before the
// line; those without a message are taken where no other reading makes sense. Edges that are in no
// character lessen the worth. Where there is nothing to go by, idle is high.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "dsp/units.hpp"

namespace sim {

/// Edges of a line from its start on; the level before the first of them.
struct LineStretch {
  bool initial = true;
  std::span<const dsp::Seconds> edges;
  dsp::Seconds end;
  dsp::Seconds resolution{};  // between two samples; 0: edges are exact
};

/// One way to read a line, and what it makes of it.
struct LineReading {
  bool inverted = false;  // idle is low: light is 1
  dsp::Hertz baud{600};
  std::uint64_t characters = 0, framing_errors = 0;
  std::uint64_t of_text = 0;     // characters without a framing error that text has
  std::uint64_t messages = 0;    // whole ones, by their checksums
  std::uint64_t most_alike = 0;  // characters of the value that most have
  bool is_against_pauses = false;
  std::uint64_t edges = 0;  // of the line; a character has ten at most

  /// From 0 to 1 by its characters; above where there are messages.
  double worth() const;
};

struct LineFacts {
  enum class Basis {
    told,        // by the user
    characters,  // it is what makes sense of them
    pauses,      // the longest stretch is idle
    assumed      // nothing tells
  };

  bool inverted = false;
  dsp::Hertz baud{600};
  Basis polarity_by = Basis::assumed, baud_by = Basis::assumed;
  LineReading reading;               // the one taken
  std::optional<LineReading> rival;  // another that is about as good
};

/// Whether there are edges, and they make characters as those of a line are.
bool makes_sense(const LineReading& reading);

/// Why what was read is no line, or one of which too little is known; not asked where a rate was
/// told. Of noise, and of another code such as 8E1, about half of the characters have a framing
/// error.
std::optional<std::string> why_no_line(const LineFacts& facts);

/// Edges of a line's beginning that are enough to tell what it is like.
constexpr std::size_t most_surveyed_edges = 32768;

/// What is told is kept; what is found is at most 1 MBd, and half of the samples a second. A line
/// that tells nothing is idle high, of 600 Bd. A rate within 2.5 % of a standard one is that.
LineFacts survey_line(const LineStretch& line, std::optional<bool> inverted,
                      std::optional<dsp::Hertz> baud);

bool is_standard_rate(dsp::Hertz rate);

/// Until when a line is known: where a capture of changes ends with its last edge, the level goes
/// on for the rest of a character.
dsp::Seconds end_of_line(std::optional<dsp::Seconds> last_edge, dsp::Seconds end, dsp::Hertz baud);

/// "idle-high, 600 Bd".
std::string reading_text(const LineReading& reading);

}  // namespace sim
