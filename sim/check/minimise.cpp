#include "sim/check/minimise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

#include "protocol/cosys.hpp"
#include "protocol/uart.hpp"
#include "sim/text/escaped_text.hpp"

namespace sim {
namespace {

using protocol::bits_per_byte;
using Indices = std::vector<std::size_t>;

/// A stop bit lasts until the next character.
std::vector<WirePiece> pieces_of(const OneFrame& frame) {
  const FrameOnLine& place = frame.frame();
  std::vector<WirePiece> all{{place.from, place.byte_start.front(), true}};
  for (std::size_t i = 0; i < place.byte_start.size(); ++i)
    for (int slot = 0; slot < bits_per_byte; ++slot) {
      const dsp::Seconds from = place.byte_start[i] + place.bit * slot;
      all.back().to = from;
      all.push_back({from, from + place.bit, protocol::line_bit(frame.judged.link.bytes[i], slot)});
    }
  all.push_back({all.back().to, place.to, true});
  return all;
}

std::span<const dsp::Seconds> edges_inside(const dsp::LogicTrace& wire, const WirePiece& piece) {
  const auto edges = wire.edges();
  const auto first = std::ranges::upper_bound(edges, piece.from);
  return {first, std::ranges::lower_bound(first, edges.end(), piece.to)};
}

bool is_disturbed(const dsp::LogicTrace& wire, const WirePiece& piece) {
  return wire.level_at(piece.from) != piece.sent || !edges_inside(wire, piece).empty();
}

/// The wire with all but some pieces as they were sent.
dsp::LogicTrace mended(const OneFrame& frame, const std::vector<WirePiece>& pieces,
                       const Indices& disturbed) {
  const dsp::LogicTrace& old = frame.line.wire;
  dsp::LogicTrace wire(old.initial());
  for (const dsp::Seconds edge : old.edges())
    if (edge < frame.frame().from) wire.add_edge(edge);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const WirePiece& piece = pieces[i];
    const bool as_it_was = std::ranges::binary_search(disturbed, i);
    wire.set_at(piece.from, as_it_was ? old.level_at(piece.from) : piece.sent);
    if (as_it_was)
      for (const dsp::Seconds edge : edges_inside(old, piece)) wire.add_edge(edge);
  }
  wire.set_at(frame.frame().to, true);
  for (const dsp::Seconds edge : old.edges())
    if (edge > frame.frame().to) wire.add_edge(edge);
  wire.observe_until(old.end());
  return wire;
}

/// `set` without its `chunk`th part of `chunks`.
Indices without(const Indices& set, std::size_t chunk, std::size_t chunks) {
  const std::size_t from = set.size() * chunk / chunks, to = set.size() * (chunk + 1) / chunks;
  Indices rest(set.begin(), set.begin() + static_cast<std::ptrdiff_t>(from));
  rest.insert(rest.end(), set.begin() + static_cast<std::ptrdiff_t>(to), set.end());
  return rest;
}

/// `breaks(set)` is true; so it is for what comes back, and for nothing with one index less.
Indices least(Indices set, const std::function<bool(const Indices&)>& breaks) {
  std::size_t chunks = 2;
  while (!set.empty()) {
    chunks = std::min(chunks, set.size());
    bool smaller = false;
    for (std::size_t chunk = 0; chunk < chunks && !smaller; ++chunk) {
      Indices rest = without(set, chunk, chunks);
      smaller = breaks(rest);
      if (smaller) set = std::move(rest);
    }
    if (!smaller && chunks == set.size()) break;
    chunks = smaller ? std::max<std::size_t>(chunks - 1, 2) : 2 * chunks;
  }
  return set;
}

std::string level_text(const dsp::LogicTrace& wire, const WirePiece& piece) {
  std::string text;
  dsp::Seconds from = piece.from;
  bool level = wire.level_at(from);
  const auto add = [&](dsp::Seconds to) {
    text += fmt::format("{}{:d} for {:.0f} us", text.empty() ? "" : ", ", level,
                        (to - from).value * 1e6);
    from = to;
    level = !level;
  };
  for (const dsp::Seconds edge : edges_inside(wire, piece)) add(edge);
  add(piece.to);
  return text;
}

/// What a piece is of the message.
std::string piece_text(const Minimised& least, std::size_t index) {
  if (index == 0) return "before the message";
  if (index + 1 == least.pieces.size()) return "behind the message";
  const std::size_t bit = index - 1;
  return place_text(least.frame, {bit / bits_per_byte, static_cast<int>(bit % bits_per_byte)});
}

}  // namespace

std::optional<Minimised> minimise(const OneFrame& frame, const Decoder& candidate,
                                  const Decoder& baseline) {
  Minimised result{.frame = frame, .pieces = pieces_of(frame), .disturbed = {}};
  for (std::size_t i = 0; i < result.pieces.size(); ++i)
    if (is_disturbed(frame.line.wire, result.pieces[i])) result.disturbed.push_back(i);
  result.at_first = result.disturbed.size();
  result.accepts_wrongly = outcome_of(candidate, frame).undetected_error;
  const auto breaks = [&](const Indices& disturbed) {
    result.frame.line.wire = mended(frame, result.pieces, disturbed);
    const FrameOutcome one = outcome_of(candidate, result.frame);
    const bool is_bad = result.accepts_wrongly ? one.undetected_error : one.lost();
    if (!is_bad) return false;
    const FrameOutcome other = outcome_of(baseline, result.frame);
    return result.accepts_wrongly ? !other.unknown && !other.undetected_error : other.delivered;
  };
  if (!breaks(result.disturbed)) return std::nullopt;
  result.disturbed = least(result.disturbed, breaks);
  result.frame.line.wire = mended(frame, result.pieces, result.disturbed);
  return result;
}

std::string disturbed_text(const Minimised& least, const Decoder& candidate,
                           const Decoder& baseline) {
  std::string text = fmt::format(
      "of {} disturbed bits {} {} enough: {} {}, {} does not\n", least.at_first,
      least.disturbed.size(), least.disturbed.size() == 1 ? "is" : "are", candidate.name(),
      least.accepts_wrongly ? "accepts what was not sent" : "loses the frame", baseline.name());
  for (const std::size_t i : least.disturbed)
    text += fmt::format("  {}: {:d} was sent; {}\n", piece_text(least, i), least.pieces[i].sent,
                        level_text(least.frame.line.wire, least.pieces[i]));
  return text;
}

std::string test_vector(const Minimised& least) {
  const FrameOnLine& place = least.frame.frame();
  std::vector<long> changes;
  for (const dsp::Seconds edge : least.frame.line.wire.edges())
    if (edge >= place.from && edge <= place.to)
      changes.push_back(std::lround((edge - place.from).value * 1e6));
  std::string numbers;
  for (std::size_t i = 0; i < changes.size(); ++i)
    numbers += fmt::format("{}{}", i == 0 ? "    " : i % 12 == 0 ? ",\n    " : ", ", changes[i]);
  const JudgedLink& judged = least.frame.judged;
  return fmt::format(
             "// \"{} {:02X}\\n\" at {:g} baud: the line is 1, and changes after so many "
             "microseconds.\n",
             escaped(judged.link.message), protocol::cosys_checksum(judged.link.message),
             judged.baud.value) +
         "static const unsigned long changes_us[] = {\n" + numbers + "};\n";
}

}  // namespace sim
