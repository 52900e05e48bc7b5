#include "sim/check/frame_trace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "protocol/cosys.hpp"
#include "protocol/uart.hpp"
#include "sim/check/frame_picture.hpp"
#include "sim/columns/text_table.hpp"
#include "sim/text/escaped_text.hpp"

namespace sim {
namespace {

std::string bits_text(const std::vector<bool>& bits) {
  std::string text;
  for (const bool bit : bits) text += bit ? '1' : '0';
  return text;
}

/// The edges within half a bit of `at`.
std::vector<dsp::Seconds> edges_near(const OneFrame& frame, dsp::Seconds at) {
  const auto edges = frame.line.wire.edges();
  const dsp::Seconds reach = frame.frame().bit * 0.5;
  const auto first = std::ranges::lower_bound(edges, at - reach);
  const auto last = std::ranges::lower_bound(edges, at + reach);
  return {first, last};
}

/// By how much the pin's edges are late, in microseconds; "-" where one is missing, "*" behind one
/// that is not alone.
std::string edges_text(const OneFrame& frame, std::size_t character) {
  const FrameOnLine& place = frame.frame();
  const std::vector<bool> bits = sent_bits(frame, character);
  bool before = true;  // the line is idle, or at a stop bit
  std::string text;
  for (std::size_t slot = 0; slot < bits.size(); ++slot) {
    if (bits[slot] != before) {
      const dsp::Seconds at = place.byte_start[character] + place.bit * static_cast<double>(slot);
      const auto edges = edges_near(frame, at);
      text += text.empty() ? "" : " ";
      text += edges.empty() ? "-" : fmt::format("{:+.0f}", (edges.front() - at).value * 1e6);
      if (edges.size() > 1) text += "*";
    }
    before = bits[slot];
  }
  return text;
}

/// What was read of a character that is at this place on the wire.
std::string reading_of(const OneFrame& frame, const std::vector<protocol::UartByte>& bytes,
                       std::size_t character) {
  const FrameOnLine& place = frame.frame();
  std::string text;
  for (const protocol::UartByte& byte : bytes) {
    const double late = (byte.start - place.byte_start[character]) / place.bit;
    if (late < -0.5 || late >= protocol::bits_per_byte - 0.5) continue;
    text += (text.empty() ? "" : " ") + quoted(byte.value);
    if (byte.framing_error) text += "!";
    if (late > 1) text += fmt::format(" (bit {:.0f})", std::round(late));
  }
  return text.empty() ? "-" : text;
}

std::string verdict_on_frame(const Decoded& decoded, const FrameOutcome& outcome) {
  if (decoded.fault) return "failed: " + decoded.fault->what;
  if (outcome.unknown) return "failed: of the markers beside the frame one was not received";
  if (outcome.undetected_error)
    return outcome.delivered ? "delivered, and another message" : "undetected error";
  return outcome.delivered ? "delivered" : "lost";
}

/// What a decoder that says no characters accepted between the markers.
std::string accepted_text(const Decoded& decoded, std::uint32_t trial) {
  std::string text;
  const auto accepted = accepted_between_markers(decoded.accepted, trial);
  for (const std::string& message : accepted.value_or(std::vector<std::string>()))
    text += fmt::format("    accepted \"{}\"\n", escaped(message));
  return text;
}

/// The lines that ended or not between the markers, as the plain decoder takes them.
std::string lines_of(const std::vector<protocol::UartByte>& bytes, const FrameOnLine& place) {
  std::string text;
  protocol::CosysDecoder decoder;
  for (const protocol::UartByte& byte : bytes) {
    if (byte.start < place.from || byte.start > place.to) continue;
    if (const auto line = decoder.push(byte))
      text += fmt::format("    \"{}\": {}\n", escaped(line->message), name(line->outcome));
  }
  if (!decoder.pending().empty())
    text += fmt::format("    \"{}\": no newline\n", escaped(decoder.pending()));
  return text;
}

/// What decoders read, each with its name.
struct NamedReading {
  std::string name;
  std::vector<protocol::UartByte> bytes;
};
using Readings = std::vector<NamedReading>;

/// Those that say characters, or else what one does that is at hand.
Readings readings_of(const OneFrame& frame, const std::vector<const Decoder*>& decoders) {
  Readings readings;
  for (const Decoder* decoder : decoders)
    if (auto bytes = decoder->characters(frame.line); !bytes.empty())
      readings.push_back({decoder->name(), std::move(bytes)});
  if (!readings.empty()) return readings;
  const auto reference = make_built_in_decoder(reference_decoder);
  return {{reference->name() + " (built in)", reference->characters(frame.line)}};
}

std::string table_of(const OneFrame& frame, const Readings& readings) {
  std::vector<TextColumn> columns{{{"", "", "ms"}, 7},
                                  {{"", "", "sent"}, -6},
                                  {{"", "", "bits"}, -10},
                                  {{"", "", "at the pin"}, -10},
                                  {{"", "edges late by", "microseconds"}, -36}};
  for (const NamedReading& reading : readings)
    columns.push_back(
        {{"", "", reading.name}, -std::max(16, static_cast<int>(reading.name.size()))});
  std::string text = table_head(columns);
  const FrameOnLine& place = frame.frame();
  for (std::size_t i = 0; i < place.byte_start.size(); ++i) {
    std::vector<std::string> row{
        fmt::format("{:.1f}", (place.byte_start[i] - place.byte_start[0]).value * 1e3),
        quoted(frame.judged.link.bytes[i]), bits_text(sent_bits(frame, i)),
        bits_text(pin_bits(frame, i)), edges_text(frame, i)};
    for (const NamedReading& reading : readings) row.push_back(reading_of(frame, reading.bytes, i));
    text += table_line(columns, row);
  }
  return text;
}

std::string verdict_lines(const Decoder& decoder, const OneFrame& frame) {
  const Decoded decoded = decoder.decode(frame.line);
  const std::vector<protocol::UartByte> characters = decoder.characters(frame.line);
  return fmt::format("{}: {}\n", decoder.name(),
                     verdict_on_frame(decoded, outcome_of(decoded, frame))) +
         (characters.empty() ? accepted_text(decoded, frame.trial())
                             : lines_of(characters, frame.frame()));
}

}  // namespace

std::string frame_trace(const OneFrame& frame, const std::vector<const Decoder*>& decoders) {
  const Link& link = frame.judged.link;
  std::string text =
      fmt::format("trial {}: \"{}\" at {:.4g} mW/m2, bits of {:.1f} us on the receiver's clock\n",
                  frame.trial(), escaped(link.message), link.operating.irradiance_mw_per_m2,
                  frame.frame().bit.value * 1e6);
  text += frame_picture(frame) + table_of(frame, readings_of(frame, decoders));
  for (const Decoder* decoder : decoders) text += verdict_lines(*decoder, frame);
  return text;
}

}  // namespace sim
