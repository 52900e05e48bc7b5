#include "dsp/spectrum.hpp"

#include <fftw3.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <map>
#include <memory>
#include <mutex>
#include <numbers>
#include <numeric>

namespace dsp {
namespace {

using std::numbers::pi;

struct DestroyPlan {
  void operator()(fftw_plan plan) const { fftw_destroy_plan(plan); }
};
using Plan = std::unique_ptr<fftw_plan_s, DestroyPlan>;

// The windowed segment and its transform.
struct Buffers {
  std::vector<double> in;
  std::vector<std::complex<double>> out;

  explicit Buffers(std::size_t n) : in(n), out(n / 2 + 1) {}
  fftw_complex* bins() { return reinterpret_cast<fftw_complex*>(out.data()); }
};

// FFTW's planner is not thread safe, its plans are. ESTIMATE: the same plan, so the same bits,
// every time; UNALIGNED: a plan serves every caller's buffers.
fftw_plan plan_for(Buffers& buffers) {
  static std::mutex planner;
  static std::map<std::size_t, Plan> plans;
  const std::lock_guard lock(planner);
  Plan& plan = plans[buffers.in.size()];
  if (!plan) {
    plan.reset(fftw_plan_dft_r2c_1d(static_cast<int>(buffers.in.size()), buffers.in.data(),
                                    buffers.bins(), FFTW_ESTIMATE | FFTW_UNALIGNED));
  }
  return plan.get();
}

// The periodic Hann window, which suits averaged spectra.
std::vector<double> hann(std::size_t n) {
  std::vector<double> window(n);
  for (std::size_t i = 0; i < n; ++i) {
    window[i] = 0.5 - 0.5 * std::cos(2 * pi * static_cast<double>(i) / static_cast<double>(n));
  }
  return window;
}

double mean_of(std::span<const float> samples) {
  return std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(samples.size());
}

void window_segment(std::span<const float> segment, std::span<const double> window, Mean mean,
                    std::span<double> out) {
  const double offset = mean == Mean::remove ? mean_of(segment) : 0.0;
  for (std::size_t i = 0; i < segment.size(); ++i) out[i] = window[i] * (segment[i] - offset);
}

// Sum over all segments of the squared magnitudes of the bins; returns the number of segments.
std::size_t add_periodograms(std::span<const float> samples, std::span<const double> window,
                             Mean mean, std::span<double> power) {
  Buffers buffers(window.size());
  const fftw_plan plan = plan_for(buffers);
  std::size_t count = 0;
  for (std::size_t at = 0; at + window.size() <= samples.size(); at += window.size() / 2) {
    window_segment(samples.subspan(at, window.size()), window, mean, buffers.in);
    fftw_execute_dft_r2c(plan, buffers.in.data(), buffers.bins());
    for (std::size_t k = 0; k < power.size(); ++k) power[k] += std::norm(buffers.out[k]);
    ++count;
  }
  return count;
}

// Zero and half the sample rate have no mirror image to add to them.
bool is_single(std::size_t bin, std::size_t n) { return bin == 0 || 2 * bin == n; }

}  // namespace

Spectrum welch(std::span<const float> samples, Hertz sample_rate, std::size_t segment, Mean mean) {
  assert(sample_rate.value > 0);
  const std::size_t n = std::min(segment, samples.size());
  assert(n >= 2);
  const std::vector<double> window = hann(n);
  Spectrum s{std::vector<double>(n / 2 + 1), std::vector<double>(n / 2 + 1)};
  const std::size_t count = add_periodograms(samples, window, mean, s.density);
  const double energy = std::inner_product(window.begin(), window.end(), window.begin(), 0.0);
  const double scale = 1 / (energy * sample_rate.value * static_cast<double>(count));
  for (std::size_t k = 0; k < s.density.size(); ++k) {
    s.frequency_hz[k] = static_cast<double>(k) * sample_rate.value / static_cast<double>(n);
    s.density[k] *= is_single(k, n) ? scale : 2 * scale;
  }
  return s;
}

double line_amplitude(std::span<const float> samples, Hertz sample_rate, Hertz f) {
  assert(!samples.empty() && f.value >= 0 && 2 * f.value <= sample_rate.value);
  std::complex<double> sum = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double cycles = static_cast<double>(i) * (f / sample_rate);
    sum += double{samples[i]} * std::polar(1.0, -2 * pi * (cycles - std::floor(cycles)));
  }
  const bool single = f.value == 0 || 2 * f.value == sample_rate.value;
  return (single ? 1 : 2) * std::abs(sum) / static_cast<double>(samples.size());
}

double band_power(const Spectrum& spectrum, Hertz f_low, Hertz f_high) {
  assert(spectrum.frequency_hz.size() >= 2);
  const double width = spectrum.frequency_hz[1] - spectrum.frequency_hz[0];
  const auto& f = spectrum.frequency_hz;
  const auto first = std::lower_bound(f.begin(), f.end(), f_low.value) - f.begin();
  const auto last = std::upper_bound(f.begin(), f.end(), f_high.value) - f.begin();
  if (last <= first) return 0;
  return width *
         std::accumulate(spectrum.density.begin() + first, spectrum.density.begin() + last, 0.0);
}

}  // namespace dsp
