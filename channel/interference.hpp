#pragma once
// Light of others at the module, sample by sample. Three kinds of source add up to any lamp or
// sender: sinusoids (the fast ripple of an electronic ballast), a table of one period (what follows
// the mains, PWM) and keyed carriers (remotes, other devices; channel/keyed_carrier.hpp). What
// reaches the module of a carrier may change along a way: its gain.
#include <cstdint>

#include "dsp/lanes.hpp"
#include "dsp/whole_turn.hpp"

namespace channel {

/// A sinusoid of a lamp: amplitude * cos(harmonic * phase of the lamp + phase). Read in the middle
/// of each sample, so its amplitude is exact at every frequency below half the sample rate. Whoever
/// designs one leaves out what lies above: it would come back as another frequency.
struct ToneDesign {
  std::uint32_t step;            // of its own phase in a sample, in 2^-32 cycles
  std::uint32_t phase;           // at time 0 if the lamp's is 0, in 2^-32 cycles
  std::uint32_t harmonic;        // cycles of this tone in a cycle of the lamp
  float turn_cosine, turn_sine;  // of `step`
  float amplitude;               // mW/m2
};

/// Samples that a source may add at a time.
constexpr int longest_interference_block = 256;

/// Samples from one knot of a gain to the next; between them it is a straight line. A whole number
/// of blocks.
constexpr int gain_step = 4096;

/// A gain over the samples of one block.
template <class T>
class GainRamp {
 public:
  /// `knots`: at samples 0, gain_step, 2 gain_step ..., one behind the block at least.
  GainRamp(const float* knots, std::int64_t first)
      : start_(knots[first / gain_step]),
        slope_((knots[first / gain_step + 1] - start_) * (1.0f / gain_step)),
        offset_(static_cast<int>(first % gain_step)) {}

  /// At sample `i` of the block.
  T operator()(int i) const { return T(start_ + slope_ * static_cast<float>(offset_ + i)); }

 private:
  float start_, slope_;
  int offset_;
};

/// One sinusoid: its phase is counted exactly, its wave turned from sample to sample in a block.
template <class T>
class Tone {
 public:
  explicit Tone(const ToneDesign& d)
      : harmonic_(d.harmonic),
        start_(d.phase + d.step / 2),
        step_(d.step),
        cosine_(d.turn_cosine),
        sine_(d.turn_sine),
        amplitude_(d.amplitude) {}

  /// The lamp's phase at time 0, in 2^-32 cycles.
  void load(int lane, std::uint32_t lamp_phase) {
    dsp::set_lane(phase_, lane, start_ + harmonic_ * lamp_phase);
  }

  /// Adds the next `n` samples. A trial gives the same bits wherever its blocks begin alike.
  void add(T* x, int n) {
    const auto now = dsp::whole_turn<T>(phase_);
    T c = amplitude_ * now.cosine, s = amplitude_ * now.sine;
    for (int i = 0; i < n; ++i) {
      x[i] = x[i] + c;
      const T turned = dsp::fused(c, cosine_, -(s * sine_));
      s = dsp::fused(s, cosine_, c * sine_);
      c = turned;
    }
    phase_ = phase_ + dsp::Words<T>(step_ * static_cast<std::uint32_t>(n));
  }

 private:
  std::uint32_t harmonic_, start_, step_;
  dsp::Words<T> phase_ = dsp::Words<T>(0u);
  T cosine_, sine_, amplitude_;
};

/// A repeating waveform that each lane reads from a place of its own.
template <class T>
class PeriodicTable {
 public:
  /// `samples`, mW/m2: those of a period, then the same ones from the first on, a block of them.
  PeriodicTable(const float* samples, std::uint32_t period) : samples_(samples), period_(period) {}

  /// The place at time 0, in 2^-32 periods; taken to the sample.
  void load(int lane, std::uint32_t phase) {
    at_[lane] = static_cast<std::uint32_t>(std::uint64_t{phase} * period_ >> 32);
  }

  /// Adds the next `n` samples, longest_interference_block at most.
  void add(T* x, int n) {
    T value{};
    for (int i = 0; i < n; ++i) {
      for (int lane = 0; lane < dsp::lanes<T>; ++lane)
        dsp::set_lane(value, lane, samples_[at_[lane] + static_cast<std::uint32_t>(i)]);
      x[i] = x[i] + value;
    }
    for (std::uint32_t& at : at_) at = (at + static_cast<std::uint32_t>(n)) % period_;
  }

 private:
  const float* samples_;
  std::uint32_t period_;
  std::uint32_t at_[dsp::lanes<T>] = {};
};

}  // namespace channel
