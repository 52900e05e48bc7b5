#include "sim/capture/envelope_detector.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sim {
namespace {

constexpr std::uint64_t samples_a_block = 1024;  // turned by multiplication alone

std::size_t samples_in(dsp::Seconds window, dsp::Hertz rate) {
  return static_cast<std::size_t>(std::clamp(std::round(dsp::cycles(window, rate)), 1.0, 1e6));
}

}  // namespace

std::complex<double> MovingMean::push(std::complex<double> sample) {
  sum_ += sample - last_[next_];
  last_[next_] = sample;
  if (++next_ == last_.size()) next_ = 0;
  return sum_ / static_cast<double>(last_.size());
}

EnvelopeDetector::EnvelopeDetector(dsp::Hertz carrier, dsp::Hertz sample_rate, dsp::Seconds window)
    : carrier_(carrier),
      sample_rate_(sample_rate),
      window_(samples_in(window, sample_rate)),
      first_(window_),
      second_(window_),
      step_(std::polar(1.0, -2 * std::numbers::pi * (carrier / sample_rate))) {}

double EnvelopeDetector::push(std::complex<float> sample) {
  if (count_ % samples_a_block == 0) {
    const double turns = static_cast<double>(count_) * (carrier_ / sample_rate_);
    turn_ = std::polar(1.0, -2 * std::numbers::pi * (turns - std::floor(turns)));
  }
  const std::complex<double> down = std::complex<double>(sample) * turn_;
  turn_ *= step_;
  ++count_;
  return std::abs(second_.push(first_.push(down)));
}

dsp::Seconds EnvelopeDetector::delay() const {
  return static_cast<double>(window_ - 1) * dsp::period(sample_rate_);
}

}  // namespace sim
