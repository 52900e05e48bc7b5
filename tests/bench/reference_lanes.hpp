#pragma once
// The reference chain as this project writes a chain: dsp::NormalSource, a trial a lane, blocks of
// noise, and short loops whose state stays in registers. T is Lanes8, or float for the tests.
#include <array>

#include "dsp/lanes.hpp"
#include "dsp/normal.hpp"
#include "dsp/philox.hpp"
#include "reference_link.hpp"

namespace bench {
inline namespace COSYS_ISA {

/// Both biquads and the rectifier. A receiver that compares with its own peak does not know its
/// gain, so b0 = 1: three operations a biquad.
template <class T>
class RectifiedBandPass {
 public:
  T operator()(T x) {
    const T y = first_(*this, x), z = second_(*this, y);
    return dsp::from_bits(dsp::to_bits(z) & dsp::Words<T>(0x7FFFFFFFu));
  }

 private:
  struct Biquad {
    T s1{0.0f}, s2{0.0f};
    T operator()(const RectifiedBandPass& of, T x) {
      const T y = x + s1;
      s1 = dsp::fused(of.minus_a1_, y, s2);
      s2 = dsp::fused(of.minus_a2_, y, -x);
      return y;
    }
  };

  T minus_a1_{-band_pass_design().a1}, minus_a2_{-band_pass_design().a2};
  Biquad first_, second_;
};

/// Low-passes, peak tracker and trigger, likewise of any gain: each low-pass is y = k y + x. The
/// tracker needs no comparison, as the larger of its two answers is the right one. Nor does the
/// trigger: with u = x - upper peak < l = x - lower peak, w = max(u, min(l, w)) is above zero
/// once u is, no longer once l is not, and else stays on its side (the play of Krasnosel'skii and
/// Pokrovskii, "Systems with Hysteresis", 1989).
template <class T>
class EnvelopeDetector {
 public:
  void operator()(T x) {
    first_ = dsp::fused(keep_, first_, x);
    second_ = dsp::fused(keep_, second_, first_);
    peak_ = dsp::larger(dsp::fused(attack_keep_, peak_, second_),
                        dsp::fused(decay_keep_, peak_, decay_gain_ * second_));
    const T above = dsp::fused(minus_upper_, peak_, second_);
    play_ = dsp::larger(above, dsp::smaller(dsp::fused(minus_lower_, peak_, second_), play_));
  }
  dsp::Mask<T> lit() const { return play_ > T(0.0f); }

 private:
  // peak_ is the tracker's over its attack share.
  T keep_{1 - low_pass_share()}, attack_keep_{1 - share(attack)}, decay_keep_{1 - share(decay)};
  T decay_gain_{share(decay) / share(attack)};
  T minus_upper_{-upper_threshold * share(attack)}, minus_lower_{-lower_threshold * share(attack)};
  T first_{0.0f}, second_{0.0f}, peak_{0.0f}, play_{0.0f};
};

/// Two groups of links: while one waits for its last result, the other computes. For InBlocks.
template <class T>
class LaneLinks {
 public:
  static constexpr int width = dsp::lanes<T>;
  static constexpr unsigned groups = 2, count = groups * width;

  LaneLinks() {
    dsp::RandomAddress address{.seed = 1};
    for (auto& group : noise_)
      for (int i = 0; i < width; ++i, ++address.trial) group.seed(i, address.block(0));
  }

  void key(std::uint32_t lit) {
    for (auto& group : light_)
      for (int i = 0; i < width; ++i, lit >>= 1)
        for (unsigned k = 0; k < samples_per_cycle; ++k)
          dsp::set_lane(group[k], i, lit & 1 ? height_ * carrier_cycle[k] : 0.0f);
  }

  void refill() {
    for (unsigned g = 0; g < groups; ++g) noise_[g].fill(x_[g].data(), block);
  }
  void receive(unsigned begin, unsigned end) {
    filter(begin, end);
    detect(begin, end);
  }

  std::uint32_t lit() const {
    std::uint32_t all = 0;
    for (unsigned g = 0; g < groups; ++g) all |= dsp::bits(detector_[g].lit()) << (g * width);
    return all;
  }

 private:
  void filter(unsigned begin, unsigned end) {
    auto filters = filter_;
    for (unsigned i = begin; i < end; ++i)
      for (unsigned g = 0; g < groups; ++g)
        x_[g][i] = filters[g](x_[g][i] + light_[g][i % samples_per_cycle]);
    filter_ = filters;
  }
  void detect(unsigned begin, unsigned end) {
    auto detectors = detector_;
    for (unsigned i = begin; i < end; ++i)
      for (unsigned g = 0; g < groups; ++g) detectors[g](x_[g][i]);
    detector_ = detectors;
  }

  template <class Each>
  using Groups = std::array<Each, groups>;

  Groups<dsp::NormalSource<T>> noise_;
  Groups<RectifiedBandPass<T>> filter_;
  Groups<EnvelopeDetector<T>> detector_;
  Groups<std::array<T, samples_per_cycle>> light_;
  Groups<std::array<T, block>> x_;
  float height_ = 1 / noise_deviation();  // of the carrier, beside noise of deviation 1
};

}  // namespace COSYS_ISA
}  // namespace bench
