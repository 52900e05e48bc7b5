#include "sim/threads/random_spells.hpp"

namespace sim {

using dsp::Seconds;

double time_between_spells(const SpellTimes& times) {
  if (times.every.value <= 0) return 1;
  return times.every / (times.every + times.lasting);
}

RandomSpells::RandomSpells(const SpellTimes& times, const dsp::RandomAddress& draws, Seconds from)
    : times_(times), draws_(draws), until_(from) {
  const Seconds cycle = times_.every + times_.lasting;
  in_spell_ = draws_.uniform() * cycle.value >= times_.lasting.value;  // flipped at once
  flip();
}

void RandomSpells::flip() {
  in_spell_ = !in_spell_;
  until_ += draws_.exponential(in_spell_ ? times_.lasting : times_.every);
}

bool RandomSpells::has(Seconds t) {
  if (times_.every.value <= 0) return false;
  while (until_ <= t) flip();
  return in_spell_;
}

}  // namespace sim
