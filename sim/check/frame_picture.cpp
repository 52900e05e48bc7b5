#include "sim/check/frame_picture.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "protocol/uart.hpp"

namespace sim {
namespace {

constexpr std::size_t characters_shown = 3;

/// Columns of a line of the picture.
struct PictureRows {
  std::string characters, light, pin, sent, seen, marks;

  std::string text() const {
    std::string all;
    for (const auto& [name, row] : {std::pair{"", &characters},
                                    {"light", &light},
                                    {"pin", &pin},
                                    {"sent", &sent},
                                    {"at the pin", &seen},
                                    {"", &marks}})
      all += without_end(fmt::format("  {:10} {}", name, *row)) + "\n";
    return all;
  }

 private:
  static std::string without_end(std::string line) {
    line.erase(line.find_last_not_of(' ') + 1);
    return line;
  }
};

/// Half a bit of the pin: its level, or that it has a pulse shorter than that.
const char* pin_column(const dsp::LogicTrace& wire, dsp::Seconds from, dsp::Seconds to) {
  const auto edges = wire.edges();
  const auto inside = std::ranges::lower_bound(edges, to) - std::ranges::lower_bound(edges, from);
  if (inside > 1) return "|";
  return wire.level_at(from + (to - from) * 0.5) ? "▔" : "▁";
}

void add_character(const OneFrame& frame, std::size_t character, PictureRows& rows) {
  const FrameOnLine& place = frame.frame();
  const std::vector<bool> sent = sent_bits(frame, character), seen = pin_bits(frame, character);
  rows.characters +=
      fmt::format("{:{}}", quoted(frame.judged.link.bytes[character]), 2 * protocol::bits_per_byte);
  for (std::size_t slot = 0; slot < sent.size(); ++slot) {
    rows.light += sent[slot] ? "  " : "██";
    for (int half = 0; half < 2; ++half) {
      const dsp::Seconds from =
          place.byte_start[character] + place.bit * (static_cast<double>(slot) + half * 0.5);
      rows.pin += pin_column(frame.line.wire, from, from + place.bit * 0.5);
    }
    rows.sent += sent[slot] ? "1 " : "0 ";
    rows.seen += seen[slot] ? "1 " : "0 ";
    rows.marks += sent[slot] == seen[slot] ? "  " : "^ ";
  }
}

}  // namespace

std::string frame_picture(const OneFrame& frame) {
  const auto difference = first_difference(frame);
  const std::size_t all = frame.frame().byte_start.size();
  const std::size_t middle = difference ? difference->character : 0;
  const std::size_t last = std::min(all, std::max(middle + 2, characters_shown));
  PictureRows rows;
  for (std::size_t i = last - std::min(last, characters_shown); i < last; ++i)
    add_character(frame, i, rows);
  const std::string line =
      difference ? "the pin first differs from the light at " + place_text(frame, *difference)
                 : "the pin has each bit as it was sent, sampled in its middle";
  return line + "\n" + rows.text();
}

}  // namespace sim
