#include "sim/capture/sampled_line.hpp"

#include <algorithm>
#include <cmath>

#include "sim/capture/carrier.hpp"

namespace sim {
namespace {

using dsp::Hertz;
using dsp::Seconds;

constexpr std::size_t stretch_samples = std::size_t{1} << 18U;
constexpr std::size_t most_first_samples = 8 * stretch_samples;
constexpr double cycles_a_window = 10, windows_a_bit = 4;
constexpr double hysteresis = 0.1;  // of the way from level to level
constexpr Seconds level_time{0.1};

std::vector<float> real_parts(std::span<const std::complex<float>> samples) {
  std::vector<float> parts;
  parts.reserve(samples.size());
  for (const auto& sample : samples) parts.push_back(sample.real());
  return parts;
}

struct Level {
  double mean = 0, deviation = 0;
};

/// The values on one side of a threshold.
template <class Side>
Level level_of(const std::vector<double>& values, const Side& side) {
  double count = 0, sum = 0, squares = 0;
  for (const double value : values) {
    if (!side(value)) continue;
    ++count;
    sum += value;
    squares += value * value;
  }
  if (count == 0) return {};
  return {sum / count, std::sqrt(std::max(0.0, squares / count - sum * sum / (count * count)))};
}

struct Levels {
  Level weak, strong;
};

/// Those of the threshold that is in the middle between the means of what it parts (Ridler &
/// Calvard 1978), sought from the middle of the whole range on, so that a little light is enough.
Levels levels_of(const std::vector<double>& values) {
  const auto [low, high] = std::ranges::minmax(values);
  Levels levels{{low, 0}, {high, 0}};
  for (int i = 0; i < 20; ++i) {
    const double middle = (levels.weak.mean + levels.strong.mean) / 2;
    levels.weak = level_of(values, [=](double value) { return value <= middle; });
    levels.strong = level_of(values, [=](double value) { return value > middle; });
  }
  return levels;
}

/// Noise alone, parted in its middle, has levels 1.3 times the sum of their deviations apart.
bool are_two(const std::vector<double>& values) {
  if (values.empty()) return false;
  const auto [weak, strong] = levels_of(values);
  return strong.mean - weak.mean > 3 * (weak.deviation + strong.deviation);
}

/// A quarter of a bit, or ten cycles; whole cycles in any case.
Seconds window_of(Hertz carrier, const std::optional<Hertz>& baud) {
  const Seconds quarter = baud ? dsp::period(windows_a_bit * *baud) : Seconds(0);
  if (carrier.value == 0) return quarter;
  const double wanted = baud ? dsp::cycles(quarter, carrier) : cycles_a_window;
  return std::max(1.0, std::round(wanted)) * dsp::period(carrier);
}

}  // namespace

SampledLine::SampledLine(SampleCapture& capture, const LineKeying& keying)
    : capture_(capture),
      rate_(capture.sample_rate()),
      carrier_(keying.carrier.value_or(Hertz(0))),
      step_(std::min(1.0, 1 / dsp::cycles(level_time, rate_))) {
  const Samples samples = read_first(keying);
  make_detector(keying);
  light_ = detector_.has_value();
  const std::vector<double> first = strengths(samples);
  if (first.empty()) return;
  find_levels(first);
  for (const double strength : first) slice(strength);
}

SampledLine::Samples SampledLine::read_stretch() {
  Samples samples(stretch_samples);
  samples.resize(capture_.read(samples));
  return samples;
}

SampledLine::Samples SampledLine::read_first(const LineKeying& keying) {
  Samples first;
  for (;;) {
    const Samples stretch = read_stretch();
    const bool is_last = stretch.size() < stretch_samples;
    if (!is_last && first.size() >= most_first_samples) {
      count_ += first.size();
      passed_over_ = static_cast<double>(count_) * dsp::period(rate_);
      first.clear();
    }
    first.insert(first.end(), stretch.begin(), stretch.end());
    is_heard_ = tells(stretch, keying) || (is_last && tells(first, keying));
    if (is_last || is_heard_) return first;
  }
}

/// Whether a stretch is no silence; sets the carrier if it is to be found and is there.
bool SampledLine::tells(const Samples& stretch, const LineKeying& keying) {
  if (!keying.carrier && !capture_.is_complex()) {
    carrier_ = find_carrier(real_parts(stretch), rate_).value_or(Hertz(0));
    if (carrier_.value > 0) return true;
  }
  make_detector(keying);
  const bool two = are_two(strengths(stretch));
  detector_.reset();
  return two;
}

void SampledLine::make_detector(const LineKeying& keying) {
  if (carrier_.value == 0 && !capture_.is_complex()) return;
  detector_.emplace(carrier_, rate_, window_of(carrier_, keying.baud));
}

std::vector<double> SampledLine::strengths(const Samples& samples) {
  std::vector<double> values;
  values.reserve(samples.size());
  for (const auto& sample : samples)
    values.push_back(detector_ ? detector_->push(sample) : static_cast<double>(sample.real()));
  return values;
}

void SampledLine::find_levels(const std::vector<double>& first) {
  const auto [weak, strong] = levels_of(first);
  weak_level_ = weak.mean;
  strong_level_ = strong.mean;
  last_ = first.front();
  strong_ = last_ > (weak_level_ + strong_level_) / 2;
  initial_ = strong_ != light_;
}

void SampledLine::follow(double strength) {
  double& level = strong_ ? strong_level_ : weak_level_;
  level += step_ * (strength - level);
}

void SampledLine::slice(double strength) {
  const double middle = (weak_level_ + strong_level_) / 2;
  const double margin = hysteresis * (strong_level_ - weak_level_);
  const auto index = static_cast<double>(count_++);
  if ((last_ > middle) != (strength > middle))
    crossed_ = index - (strength - middle) / (strength - last_);
  last_ = strength;
  const bool other = strong_ ? strength < middle - margin : strength > middle + margin;
  if (other) {
    strong_ = !strong_;
    const Seconds delay = detector_ ? detector_->delay() : Seconds(0);
    const Seconds at = crossed_ * dsp::period(rate_) - delay;
    edges_.push_back(std::max(at, Seconds(0)));
  }
  follow(strength);
}

std::optional<Seconds> SampledLine::next() {
  while (edges_.empty()) {
    const Samples stretch = read_stretch();
    if (stretch.empty()) return std::nullopt;
    for (const double strength : strengths(stretch)) slice(strength);
  }
  const Seconds edge = edges_.front();
  edges_.pop_front();
  return edge;
}

Seconds SampledLine::known_until() const {
  return static_cast<double>(count_) * dsp::period(rate_);
}

}  // namespace sim
