#pragma once
// Spells in which something is not there, now and then: a device with other things to do, a radio
// out of reach. Times between them and they themselves are exponential, so they have no memory and
// may be looked for from any time on.
#include "dsp/random_stream.hpp"
#include "dsp/units.hpp"

namespace sim {

/// Means; every = 0: there are none.
struct SpellTimes {
  dsp::Seconds every;  // from the end of one to the start of the next
  dsp::Seconds lasting;
};

/// Share of time without a spell.
double time_between_spells(const SpellTimes& times);

class RandomSpells {
 public:
  /// At `from`, as at any other time, it may be in a spell.
  RandomSpells(const SpellTimes& times, const dsp::RandomAddress& draws, dsp::Seconds from);

  /// Times asked must not decrease, nor be before `from`.
  bool has(dsp::Seconds t);

 private:
  void flip();

  SpellTimes times_;
  dsp::RandomStream draws_;
  bool in_spell_ = false;
  dsp::Seconds until_;
};

}  // namespace sim
