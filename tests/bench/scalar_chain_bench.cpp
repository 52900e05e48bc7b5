// The yardstick: the same kind of link written plainly, one float at a time, with the standard
// library's generator, to be measured in the same run. Random 8N1 bytes at 600 baud key a 59 kHz
// square carrier at 472 kS/s; Gaussian noise at every sample, two band-pass biquads of Q = 10 (R.
// Bristow-Johnson's cookbook), rectifier, two one-pole low-passes, peak-tracking gain, Schmitt
// trigger. Simpler than our receiver module, which has a threshold follower, integrator and AGC.
#include <cmath>
#include <numbers>
#include <random>

#include "benchmark/benchmark.h"
#include "rate.hpp"

namespace bench {
namespace {

constexpr float rate = 472e3f, carrier = 59e3f, baud = 600.0f;
constexpr float pi = std::numbers::pi_v<float>;

class Biquad {  // constant 0 dB peak gain
 public:
  Biquad(float centre, float q) {
    const float w = 2 * pi * centre / rate, alpha = std::sin(w) / (2 * q), a0 = 1 + alpha;
    b_ = alpha / a0;
    a1_ = -2 * std::cos(w) / a0;
    a2_ = (1 - alpha) / a0;
  }
  float operator()(float x) {
    const float y = b_ * x + s1_;
    s1_ = s2_ - a1_ * y;
    s2_ = -b_ * x - a2_ * y;
    return y;
  }

 private:
  float b_, a1_, a2_, s1_ = 0, s2_ = 0;
};

class OnePole {
 public:
  explicit OnePole(float seconds) : share_(1 - std::exp(-1 / (seconds * rate))) {}
  float operator()(float x) { return state_ += share_ * (x - state_); }

 private:
  float share_, state_ = 0;
};

class PeakTracker {
 public:
  float operator()(float x) {
    peak_ += (x > peak_ ? attack_ : decay_) * (x - peak_);
    return peak_;
  }

 private:
  float attack_ = 1 - std::exp(-1 / (10e-3f * rate));
  float decay_ = 1 - std::exp(-1 / (200e-3f * rate));
  float peak_ = 0;
};

class Transmitter {
 public:
  float operator()() {
    ++age_;
    if ((left_ -= 1) <= 0) next_bit();
    phase_ += carrier / rate;
    if (phase_ >= 1) phase_ -= 1;
    return lit_ && phase_ < 0.5f ? 1.0f : 0.0f;
  }
  int age() const { return age_; }  // samples of the present bit so far
  bool lit() const { return lit_; }

 private:
  void next_bit() {
    age_ = 0;
    left_ += rate / baud;
    slot_ = (slot_ + 1) % 10;
    lit_ = slot_ == 0 || (slot_ != 9 && random_() % 2 == 0);
  }

  std::mt19937 random_{7};
  float left_ = 0, phase_ = 0;
  int slot_ = 9, age_ = 0;
  bool lit_ = false;
};

class Receiver {
 public:
  bool operator()(float x) {
    const float envelope = second_low_(first_low_(std::abs(second_(first_(x)))));
    const float peak = tracker_(envelope);
    light_ = envelope > (light_ ? 0.54f : 0.66f) * peak;
    return !light_;
  }

 private:
  Biquad first_{carrier, 10}, second_{carrier, 10};
  OnePole first_low_{1 / (2 * pi * 700)}, second_low_{1 / (2 * pi * 700)};
  PeakTracker tracker_;
  bool light_ = false;
};

/// Noise that makes 3 % of the bits wrong, decided 485 us behind their middle: it does receive.
void scalar_chain(benchmark::State& state) {
  constexpr int samples = 47200;
  constexpr int decision = static_cast<int>(rate / baud / 2 + 485e-6f * rate);
  Transmitter transmitter;
  Receiver receiver;
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0, 1.9f);
  int bits = 0, errors = 0;
  for (auto _ : state) {
    for (int i = 0; i < samples; ++i) {
      const bool light = !receiver(transmitter() + noise(random));
      if (transmitter.age() != decision) continue;
      ++bits;
      errors += light != transmitter.lit();
    }
  }
  report(state, samples);
  state.counters["BER"] = static_cast<double>(errors) / bits;
}
BENCHMARK(scalar_chain)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace bench
