#pragma once
// CarrierDemodulator: a wire that drives an LED, on which a carrier is keyed on and off, as the
// line that it sends: 0 from the first edge of a burst to its last. Any other wire is passed on as
// it is.
//
// A carrier is on the wire where of its first edges three in four are, from each to the next but
// one, within 30 % of the same time (a slow sampler rounds them), which is a period of 20 to
// 500 kHz, and where hardly one is far from both of its neighbours. A UART has that only if it
// sends alternating bits at more than 40 kBd.
#include <deque>
#include <optional>

#include "sim/capture/logic_capture.hpp"

namespace sim {

class CarrierDemodulator : public EdgeSource {
 public:
  /// `carrier`: 0 for a wire without; nothing: found on the wire. The wire must outlive it.
  CarrierDemodulator(EdgeSource& wire, std::optional<dsp::Hertz> carrier);

  /// 0 of a wire that is passed on.
  dsp::Hertz carrier() const { return carrier_; }

  bool initial() const override { return carrier_.value > 0 || wire_.initial(); }
  std::optional<dsp::Seconds> next() override;
  dsp::Seconds known_until() const override;
  dsp::Seconds resolution() const override { return wire_.resolution(); }

 private:
  std::optional<dsp::Seconds> next_edge();

  EdgeSource& wire_;
  dsp::Hertz carrier_{0};
  std::deque<dsp::Seconds> ahead_;  // edges that were read to find the carrier
  // Of the burst under way: its last edge, and the first edge of the next, if that was read.
  std::optional<dsp::Seconds> last_, following_;
};

}  // namespace sim
