#pragma once
// The loop over bits, the same for one trial as float and for eight in lanes. Noise is made in two
// steps: its length by a uniform number, and only where some lane's could carry the bit over the
// threshold the logarithm, the root and the angle's sine. Only the kernels include it, and who
// decides for one trial alone.
#include <cstddef>
#include <cstdint>

#include "channel/decision_kernel.hpp"
#include "dsp/lanes.hpp"
#include "dsp/normal.hpp"

namespace channel {

template <class T>
dsp::NormalSource<T> noise_of(const DecisionKernelInput& in) {
  dsp::NormalSource<T> noise;
  for (int i = 0; i < dsp::lanes<T>; ++i) noise.seed(i, in.noise_seed[i]);
  return noise;
}

/// Notes what a bit is taken for in the lanes `near` the threshold; the others keep what is noted.
template <class T>
void note(const DecisionKernelInput& in, std::size_t bit, dsp::Mask<T> near, dsp::Mask<T> light) {
  const std::uint32_t lanes = dsp::bits(near), wrong = dsp::bits(light) ^ in.sent[bit];
  in.wrong[bit] = static_cast<std::uint8_t>((in.wrong[bit] & ~lanes) | (wrong & lanes));
}

/// Two bits from each pair of normals.
template <class T>
void decide_in_phase(const DecisionKernelInput in) {
  dsp::NormalSource<T> noise = noise_of<T>(in);
  for (std::size_t bit = 0; bit < in.n_bits; bit += 2) {
    const auto draw = noise.draw();
    const auto near = draw.uniform <= T(in.bits[bit].reach);
    if (!dsp::any(near)) continue;
    const auto [first, second] = noise.normals_of(draw);
    note<T>(in, bit, near, first > T(in.bits[bit].limit));
    note<T>(in, bit + 1, near, second > T(in.bits[bit + 1].limit));
  }
}

/// A bit from each pair: in phase and in quadrature.
template <class T>
void decide_envelope(const DecisionKernelInput in) {
  dsp::NormalSource<T> noise = noise_of<T>(in);
  for (std::size_t bit = 0; bit < in.n_bits; ++bit) {
    const auto draw = noise.draw();
    const auto near = draw.uniform <= T(in.bits[bit].reach);
    if (!dsp::any(near)) continue;
    const auto [x, y] = noise.normals_of(draw);
    const T power = dsp::fused(x, x, y * y);
    note<T>(in, bit, near, dsp::fused(T(in.bits[bit].slope), x, power) > T(in.bits[bit].limit));
  }
}

template <class T>
void run_decisions(const DecisionKernelInput& in) {
  if (in.envelope)
    decide_envelope<T>(in);
  else
    decide_in_phase<T>(in);
}

}  // namespace channel
