#include "protocol/edge_timing.hpp"

#include <cmath>
#include <cstddef>
#include <utility>

namespace protocol {
namespace {

using dsp::Seconds;

/// The time between two changes.
struct Run {
  Seconds start;
  bool level;
  double bits;  // whole
};

/// Characters out of bits, one after the other.
class Characters {
 public:
  Characters(bool initial, Seconds bit) : was_high_(initial), bit_(bit) {}

  void take(const Run& run) {
    for (double i = 0; i < run.bits; ++i) {
      if (slot_ == 0 && (run.level || !was_high_)) break;  // idle for all of it
      take_bit(run.level, run.start + i * bit_);
    }
    if (run.bits > 0) was_high_ = run.level;
    if (slot_ == 0 && was_high_ == run.level) reading_.settled = run.start;
  }

  UartReading& reading() { return reading_; }

 private:
  void take_bit(bool level, Seconds at) {
    if (slot_ == 0) character_ = {.start = at};
    if (slot_ > 0 && slot_ < stop_slot)
      character_.value =
          static_cast<std::uint8_t>(character_.value | (unsigned{level} << (slot_ - 1)));
    if (slot_++ < stop_slot) return;
    character_.framing_error = !level;
    reading_.bytes.push_back(character_);
    was_high_ = level;
    slot_ = 0;
  }

  bool was_high_;
  Seconds bit_;
  int slot_ = 0;  // of the character, 0: none has begun
  UartByte character_{};
  UartReading reading_;
};

}  // namespace

UartReading read_edge_timing(const dsp::LogicTrace& line, dsp::Hertz baud) {
  const Seconds bit = dsp::period(baud);
  Characters characters(line.initial(), bit);
  const auto edges = line.edges();
  bool level = line.initial();
  for (std::size_t i = 0; i < edges.size(); ++i) {
    level = !level;
    const Seconds end = i + 1 < edges.size() ? edges[i + 1] : line.end();
    characters.take({edges[i], level, std::floor((end - edges[i]) / bit + 0.5)});
  }
  return std::move(characters.reading());
}

}  // namespace protocol
