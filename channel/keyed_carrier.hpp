#pragma once
// The light at the module: a square carrier keyed on and off by a wire's level. Each sample is the
// mean of the wave over its own interval, so carrier and keying edges fall where they fall: no
// aliasing of edges, no whole-number coincidence of sample rate, carrier and baud is relied on.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "dsp/lanes.hpp"

namespace channel {

/// Light is on from `on` to `off`, in samples from the start of the trial; both as edge_at() gives.
struct Burst {
  double on, off;
};

/// An edge on a grid so fine (0.2 ns at 1 MS/s) that its time from any block's start is exact as a
/// float: where blocks begin, and so which trials run together, cannot change a bit.
[[gnu::always_inline]] inline double edge_at(double samples) {
  return std::round(samples * 4096) / 4096;
}

struct CarrierDesign {
  std::uint32_t step;  // carrier cycles a sample, in 2^-32
  float cycles;        // the same as a float; below 1
  float duty;          // 0..1
  // Peak irradiance over `cycles`, made up for the droop of the mean over a sample.
  float amplitude;
};

/// Phase of the carrier's fundamental, a cosine, at the centre of a sample at whose start the
/// carrier has `phase`: the lit part begins a cycle. All in 2^-32 cycles.
[[gnu::always_inline]] inline std::uint32_t fundamental_phase(const CarrierDesign& d,
                                                              std::uint32_t phase) {
  return phase + d.step / 2 - static_cast<std::uint32_t>(d.duty * 0x1p31f);
}

template <class T>
class KeyedCarrier {
 public:
  struct Sample {
    T irradiance;
    dsp::Mask<T> lit;  // the burst is on in some part of this sample
  };

  explicit KeyedCarrier(const CarrierDesign& d)
      : step_(d.step), cycles_(d.cycles), duty_(d.duty), amplitude_(d.amplitude) {}

  /// Gives a lane its bursts (which must outlive this) and the carrier's phase at sample 0, in
  /// 2^-32 cycles. Bursts are in order and at least a sample apart.
  void load(int lane, std::span<const Burst> bursts, std::uint32_t phase) {
    resume(lane, bursts);
    dsp::set_lane(phase_, lane, phase);
  }

  /// Gives a lane other bursts, equal as far as they began in samples that are done.
  void resume(int lane, std::span<const Burst> bursts) {
    burst_[lane] = bursts.data();
    end_[lane] = bursts.data() + bursts.size();
  }

  /// Prepares the samples [first, first + length), 2048 at most; returns how many of them one burst
  /// a lane covers: the length of the block to run.
  int begin_block(std::int64_t first, int length) {
    constexpr double far = 1 << 11;
    for (int i = 0; i < dsp::lanes<T>; ++i) {
      const double origin = static_cast<double>(first);
      while (burst_[i] != end_[i] && burst_[i]->off <= origin) ++burst_[i];
      const bool none = burst_[i] == end_[i];
      dsp::set_lane(on_, i,
                    static_cast<float>(none ? far : std::clamp(burst_[i]->on - origin, -far, far)));
      dsp::set_lane(off_, i,
                    static_cast<float>(none ? far : std::min(burst_[i]->off - origin, far)));
      if (none || burst_[i] + 1 == end_[i]) continue;
      const double next = burst_[i][1].on - origin;
      if (next < length) length = std::max(1, static_cast<int>(next));
    }
    return length;
  }

  /// No lane is lit in the first `length` samples of the block.
  bool dark(int length) const { return !dsp::any(on_ < T(static_cast<float>(length))); }

  /// Passes over the first `length` samples of the block, which are dark.
  void skip(int length) {
    phase_ = phase_ + dsp::Words<T>(step_ * static_cast<std::uint32_t>(length));
  }

  /// The first sample of [from, length) in which a lane's burst begins or ends, or `length`.
  int next_edge(int from, int length) const {
    const T begin(static_cast<float>(from)), end(static_cast<float>(length));
    const T edge = dsp::choose(on_ >= begin, on_, dsp::choose(off_ >= begin, off_, end));
    int next = length;
    for (int i = 0; i < dsp::lanes<T>; ++i)
      next = std::min(next, static_cast<int>(dsp::lane(edge, i)));
    return next;
  }

  /// The lanes that are lit all through sample `i`, where none has an edge.
  dsp::Mask<T> lit_at(int i) const {
    const T start(static_cast<float>(i));
    return (on_ <= start) & (off_ > start);
  }

  /// Irradiance of the next sample in which no lane has an edge, `lit` being lit_at(): that of
  /// operator(), to the bit.
  T steady(dsp::Mask<T> lit) {
    const T phase = next_phase();
    const T light = lit_time(phase + cycles_) - dsp::smaller(phase, duty_);
    return dsp::choose(lit, amplitude_ * light, T(0.0f));
  }

  /// Sample `i` of the block; to be called for each in turn, or steady() instead.
  Sample operator()(int i) {
    const T zero(0.0f), one(1.0f), start(static_cast<float>(i));
    const T from = dsp::smaller(dsp::larger(on_ - start, zero), one);
    const T to = dsp::smaller(dsp::larger(off_ - start, zero), one);
    const T phase = next_phase();
    const T light =
        lit_time(dsp::fused(to, cycles_, phase)) - lit_time(dsp::fused(from, cycles_, phase));
    return {amplitude_ * light, from < to};
  }

 private:
  /// In cycles, 0 to 1: that of a sample's start; counts on.
  T next_phase() {
    const T phase = dsp::to_float(phase_ >> 8) * T(0x1p-24f);
    phase_ = phase_ + dsp::Words<T>(step_);
    return phase;
  }

  /// Cycles of light from phase 0 to phase p, p in [0, 2): the integral of the square wave.
  T lit_time(T p) const {
    const T second = dsp::larger(p - T(1.0f), T(0.0f));  // the part in the second cycle
    return dsp::smaller(p, duty_) + dsp::smaller(second, duty_);
  }

  std::uint32_t step_;
  dsp::Words<T> phase_ = dsp::Words<T>(0u);
  T cycles_, duty_, amplitude_;
  T on_, off_;  // the lane's burst, in samples from the block's start
  const Burst* burst_[dsp::lanes<T>] = {};
  const Burst* end_[dsp::lanes<T>] = {};
};

}  // namespace channel
