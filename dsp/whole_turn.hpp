#pragma once
// Cosine and sine of a phase word, for one trial or many: what a correlator multiplies with.
#include "dsp/lanes.hpp"
#include "dsp/normal.hpp"

namespace dsp {

template <class T>
struct Phasor {
  T cosine, sine;
};

/// Of a phase in 2^-32 turns; absolute error below 2e-7. Quadrants by exchange and sign alone.
template <class T>
Phasor<T> whole_turn(Words<T> phase) {
  const auto [s, c] = quarter_turn(to_float((phase << 2) >> 8) * T(0x1p-24f));
  const Words<T> a = to_bits(c), b = to_bits(s), sign(0x80000000u);
  const Words<T> exchanged = (a ^ b) & arithmetic_shift(phase << 1, 31);  // in quadrants 1 and 3
  return {from_bits((a ^ exchanged) ^ ((phase ^ (phase << 1)) & sign)),
          from_bits((b ^ exchanged) ^ (phase & sign))};
}

}  // namespace dsp
