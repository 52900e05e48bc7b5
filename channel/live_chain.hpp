#pragma once
// A chain that goes on while its LEDs are being keyed: for who answers to what is heard. Bit by bit
// the pin is that of propagate() with all that was keyed in the end.
#include <cstddef>
#include <memory>

#include "channel/chain.hpp"
#include "dsp/logic_trace.hpp"
#include "dsp/units.hpp"

namespace channel {

class LiveChain {
 public:
  /// `input`: its drive, and those of its disturbances, are wires on which nothing is keyed yet.
  /// The design must outlive this.
  LiveChain(const ChainDesign& design, const ChainInput& input);
  ~LiveChain();
  LiveChain(LiveChain&&) noexcept;

  /// More of what drives the LED; low = light, all of it behind what was advanced to and what was
  /// keyed before.
  void key(const dsp::LogicTrace& drive);
  /// The same for the LED of a disturbance.
  void key_disturbance(std::size_t which, const dsp::LogicTrace& drive);

  /// Goes on to a time not far (less than a block of samples) before `t`: reached().
  void advance(dsp::Seconds t);
  dsp::Seconds reached() const;

  /// The pin so far.
  const dsp::LogicTrace& pin() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace channel
