#pragma once
// A serial line one way: bytes go over it one after the other, some are changed, some lost.
#include <deque>

#include "dsp/random_stream.hpp"
#include "dsp/units.hpp"
#include "protocol/uart.hpp"
#include "sim/threads/random_spells.hpp"

namespace sim {

struct LineSettings {
  dsp::Hertz baud;
  double byte_error_ratio;
  SpellTimes outages;
};

class SerialLine {
 public:
  /// Bytes are changed by the draws of one address; outages have the other's.
  SerialLine(const LineSettings& settings, const dsp::RandomAddress& damage,
             const dsp::RandomAddress& outages)
      : settings_(settings),
        damage_(damage),
        outages_(settings.outages, outages, dsp::Seconds(0)) {}

  /// Whether all that was sent has gone over it.
  bool is_free(dsp::Seconds now) const { return free_at_ <= now; }
  void send(const protocol::Bytes& bytes, dsp::Seconds now);

  /// The next byte that has arrived by then, if it has one: true also of one that was lost.
  bool arrived(dsp::Seconds now) const { return !flying_.empty() && flying_.front().end <= now; }
  struct Arrival {
    protocol::UartByte sent;  // as it was
    protocol::UartByte byte;  // as it came
    bool lost;
  };
  Arrival take();

 private:
  struct Flight {
    dsp::Seconds start, end;
    std::uint8_t value;
  };

  LineSettings settings_;
  dsp::RandomStream damage_;
  RandomSpells outages_;
  std::deque<Flight> flying_;
  dsp::Seconds free_at_;
};

}  // namespace sim
