#pragma once
// Chains that go on while their LEDs are being keyed, several at once in the lanes of one kernel:
// for who answers to what is heard. Bit by bit a pin is that of propagate() with all that was keyed
// in the end.
#include <cstddef>
#include <memory>
#include <span>

#include "channel/chain.hpp"
#include "channel/instruction_set.hpp"
#include "dsp/logic_trace.hpp"
#include "dsp/units.hpp"

namespace channel {

class LiveChains {
 public:
  /// One chain an input, trials_at_once(set) at most. Drives of the inputs are wires on which
  /// nothing is keyed yet; those of disturbances are taken as they are. The design must outlive
  /// this.
  LiveChains(const ChainDesign& design, std::span<const ChainInput> inputs,
             InstructionSet set = InstructionSet::best);
  ~LiveChains();
  LiveChains(LiveChains&&) noexcept;

  /// More of what drives the LED of a chain; low = light, all of it behind what was advanced to and
  /// what was keyed before.
  void key(std::size_t chain, const dsp::LogicTrace& drive);
  /// The same for the LED of one of its disturbances.
  void key_disturbance(std::size_t chain, std::size_t which, const dsp::LogicTrace& drive);

  /// All go on to a time not far (less than a block of samples) before `t`.
  void advance(dsp::Seconds t);

  /// The pin of a chain so far.
  const dsp::LogicTrace& pin(std::size_t chain) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace channel
