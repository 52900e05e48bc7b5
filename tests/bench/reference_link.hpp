#pragma once
// What the variants of the reference chain share: the line, the count, and the link written
// plainly, one float at a time. Each variant has compiler flags of its own, so each is in a
// namespace of its own (COSYS_ISA, as in dsp/lanes.hpp): the linker must not give one variant the
// code of another.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "reference_chain.hpp"

namespace bench {
inline namespace COSYS_ISA {

constexpr double sample_rate = 472e3, carrier = 59e3, baud = 600, samples_per_bit = 472e3 / baud;
/// From a bit's first sample to the one, itself included, behind which it is read.
constexpr int samples_to_decision =
    1 + static_cast<int>(samples_per_bit / 2 + 485e-6 * sample_rate);
constexpr unsigned samples_per_cycle = 8;
constexpr std::array<float, samples_per_cycle> carrier_cycle{1, 1, 1, 1, 0, 0, 0, 0};
constexpr double low_pass_corner = 700, attack = 10e-3, decay = 200e-3;  // Hz, s, s
constexpr float upper_threshold = 0.66f, lower_threshold = 0.54f;

/// Standard deviation of the noise beside a carrier of height 1, half of whose bits are lit: white
/// noise of density N0 has the variance N0 / 2 in a sample, energies being sums over samples.
inline float noise_deviation() {
  const double fundamental =
      2 / (samples_per_cycle * std::sin(std::numbers::pi / samples_per_cycle));
  const double bit_energy = fundamental * fundamental / 2 * samples_per_bit / 2;
  return static_cast<float>(std::sqrt(bit_energy / 2 / std::pow(10, reference_ebn0_db / 10)));
}

/// A one-pole filter moves by this share of its distance in a sample.
inline float share(double seconds) {
  return static_cast<float>(1 - std::exp(-1 / (seconds * sample_rate)));
}
inline float low_pass_share() { return share(1 / (2 * std::numbers::pi * low_pass_corner)); }

/// R. Bristow-Johnson's cookbook, band-pass of 0 dB at its peak; b1 = 0, b2 = -b0.
struct BandPassDesign {
  float b0, a1, a2;
};
inline BandPassDesign band_pass_design() {
  constexpr double q = 10;
  const double w = 2 * std::numbers::pi * carrier / sample_rate, alpha = std::sin(w) / (2 * q);
  return {static_cast<float>(alpha / (1 + alpha)),
          static_cast<float>(-2 * std::cos(w) / (1 + alpha)),
          static_cast<float>((1 - alpha) / (1 + alpha))};
}

/// Random bytes, 8N1, of up to 32 links at once: bit i of a word tells whether link i is lit.
class ByteSource {
 public:
  std::uint32_t operator()() {
    slot_ = (slot_ + 1) % 10;
    return slot_ == 0 ? ~0u : slot_ == 9 ? 0u : static_cast<std::uint32_t>(random_());
  }

 private:
  std::mt19937 random_{7};
  int slot_ = 9;
};

/// Bits of 786 or 787 samples, 786.67 in the mean.
class BitClock {
 public:
  unsigned operator()() {
    left_ += samples_per_bit;
    const auto length = static_cast<unsigned>(std::ceil(left_));
    left_ -= length;
    return length;
  }

 private:
  double left_ = 0;
};

/// Keys links, reads them and counts. Links: `count`; key(lit) for the bits to come, advance(n)
/// samples, lit() as received: bit i of a word is link i.
template <class Links>
class KeyedLinks final : public ReferenceChain {
 public:
  Tally run(int bits) override {
    Tally tally;
    for (int i = 0; i < bits; ++i) {
      const std::uint32_t sent = bytes_();
      const unsigned length = clock_();
      links_.key(sent);
      links_.advance(samples_to_decision);
      tally.errors += std::popcount((links_.lit() ^ sent) & ((1u << Links::count) - 1));
      links_.advance(length - samples_to_decision);
      tally.bits += Links::count;
      tally.samples += long{length} * Links::count;
    }
    return tally;
  }

 private:
  ByteSource bytes_;
  BitClock clock_;
  Links links_;
};

class Biquad {
 public:
  float operator()(float x) {
    const float y = design_.b0 * x + s1_;
    s1_ = s2_ - design_.a1 * y;
    s2_ = -design_.b0 * x - design_.a2 * y;
    return y;
  }

 private:
  BandPassDesign design_ = band_pass_design();
  float s1_ = 0, s2_ = 0;
};

class OnePole {
 public:
  float operator()(float x) { return state_ += share_ * (x - state_); }

 private:
  float share_ = low_pass_share(), state_ = 0;
};

class PeakTracker {
 public:
  float operator()(float x) { return peak_ += (x > peak_ ? attack_ : decay_) * (x - peak_); }

 private:
  float attack_ = share(attack), decay_ = share(decay), peak_ = 0;
};

class Receiver {
 public:
  void operator()(float x) {
    const float envelope = second_low_(first_low_(std::abs(second_(first_(x)))));
    const float peak = tracker_(envelope);
    lit_ = envelope > (lit_ ? lower_threshold : upper_threshold) * peak;
  }
  bool lit() const { return lit_; }

 private:
  Biquad first_, second_;
  OnePole first_low_, second_low_;
  PeakTracker tracker_;
  bool lit_ = false;
};

/// One link, sample by sample. Noise: operator() gives a standard normal.
template <class Noise>
class OneLink {
 public:
  static constexpr int count = 1;
  void key(std::uint32_t lit) { height_ = static_cast<float>(lit & 1); }
  // Flattened: a call of the library's generator would be one that all variants share.
  [[gnu::flatten]] void advance(unsigned n) {
    for (; n > 0; --n)
      receiver_(height_ * carrier_cycle[sample_++ % samples_per_cycle] + deviation_ * noise_());
  }
  std::uint32_t lit() const { return receiver_.lit(); }

 private:
  Noise noise_;
  Receiver receiver_;
  float deviation_ = noise_deviation(), height_ = 0;
  unsigned sample_ = 0;
};

/// Samples of a block of noise: whole cycles of the carrier, so that each begins with one.
constexpr unsigned block = 128;
static_assert(block % samples_per_cycle == 0);

/// Runs links over blocks of noise. Links: refill() makes a block, receive(begin, end) is a part.
template <class Links>
class InBlocks : public Links {
 public:
  void advance(unsigned n) {
    while (n > 0) {
      if (used_ == block) {
        Links::refill();
        used_ = 0;
      }
      const unsigned end = std::min(used_ + n, block);
      Links::receive(used_, end);
      n -= end - used_;
      used_ = end;
    }
  }

 private:
  unsigned used_ = block;
};

/// One link that has its noise in blocks: nothing is called between samples, so the receiver's
/// state is in registers. Noise: fill(normals) gives a block of standard normals.
template <class Noise>
class OneBlockLink {
 public:
  static constexpr int count = 1;
  void key(std::uint32_t lit) { height_ = static_cast<float>(lit & 1); }
  [[gnu::flatten]] void refill() { noise_.fill(normals_.data()); }
  void receive(unsigned begin, unsigned end) {
    Receiver receiver = receiver_;
    for (unsigned i = begin; i < end; ++i)
      receiver(height_ * carrier_cycle[i % samples_per_cycle] + deviation_ * normals_[i]);
    receiver_ = receiver;
  }
  std::uint32_t lit() const { return receiver_.lit(); }

 private:
  Noise noise_;
  Receiver receiver_;
  std::array<float, block> normals_{};
  float deviation_ = noise_deviation(), height_ = 0;
};

}  // namespace COSYS_ISA
}  // namespace bench
