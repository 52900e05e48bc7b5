#pragma once
// A serial line one way: bytes go over it one after the other, some are changed, some lost.
#include <deque>

#include "dsp/philox.hpp"
#include "dsp/units.hpp"
#include "protocol/uart.hpp"

namespace sim {

struct LineSettings {
  dsp::Hertz baud;
  double byte_error_ratio;
  dsp::Seconds outage_every, outage_for;  // means; 0: no outages
};

class SerialLine {
 public:
  SerialLine(const LineSettings& settings, const dsp::RandomAddress& draws);

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
  bool out_at(dsp::Seconds t);
  double uniform() { return draws_.uniform(next_++); }

  LineSettings settings_;
  dsp::RandomAddress draws_;
  std::uint32_t next_ = 0;
  std::deque<Flight> flying_;
  dsp::Seconds free_at_;
  bool out_ = false;
  dsp::Seconds until_;
};

}  // namespace sim
