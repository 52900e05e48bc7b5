#include "channel/carrier_detector.hpp"

#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

namespace channel {
namespace {

// What varies by less than this share of its energy is taken for steady: sums over a window are
// exact to 1e-13 or so.
constexpr double steady_share = 1e-10;

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double energy(std::span<const double> values) {
  return std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
}

/// Sum of (x[n] - offset) exp(i w n): Goertzel's recursion, one real product a sample, its last
/// state turned back to the first sample's phase.
std::complex<double> goertzel(std::span<const double> x, double offset, double w) {
  const double factor = 2 * std::cos(w);
  double one = 0, two = 0;
  for (const double value : x) {
    const double next = value - offset + factor * one - two;
    two = one;
    one = next;
  }
  const std::complex<double> last = one - std::polar(1.0, -w) * two;
  return std::conj(last * std::polar(1.0, -w * static_cast<double>(x.size() - 1)));
}

}  // namespace

SynchronousDetector::SynchronousDetector(std::span<const double> replica)
    : reference_(replica.begin(), replica.end()) {
  const double whole = energy(replica), steady = mean(replica);
  for (double& value : reference_) value -= steady;
  const double varying = energy(reference_);
  if (varying <= steady_share * whole) reference_.clear();
  for (double& value : reference_) value /= std::sqrt(varying);
}

double SynchronousDetector::operator()(std::span<const double> samples) const {
  assert(samples.size() == reference_.size());
  return std::inner_product(samples.begin(), samples.end(), reference_.begin(), 0.0);
}

GoertzelDetector::GoertzelDetector(double cycles_per_sample, std::size_t samples)
    : radians_(2 * std::numbers::pi * (cycles_per_sample - std::round(cycles_per_sample))),
      samples_(samples) {
  const double n = static_cast<double>(samples);
  double c = 0, s = 0;
  for (std::size_t i = 0; i < samples; ++i) {
    const double cosine = std::cos(radians_ * static_cast<double>(i));
    const double sine = std::sin(radians_ * static_cast<double>(i));
    c += cosine;
    s += sine;
    cc_ += cosine * cosine;
    cs_ += cosine * sine;
    ss_ += sine * sine;
  }
  cc_ -= c * c / n;
  cs_ -= c * s / n;
  ss_ -= s * s / n;
  const double determinant = cc_ * ss_ - cs_ * cs_;
  if (determinant > steady_share * n * n) determinant_ = determinant;
}

double GoertzelDetector::operator()(std::span<const double> samples) const {
  assert(samples.size() == samples_ && !blind());
  const std::complex<double> sum = goertzel(samples, mean(samples), radians_);
  const double c = sum.real(), s = sum.imag();
  return (ss_ * c * c - 2 * cs_ * c * s + cc_ * s * s) / determinant_;
}

double dc_difference(std::span<const double> samples, std::span<const double> reference) {
  const double n = static_cast<double>(samples.size()), m = static_cast<double>(reference.size());
  return (mean(samples) - mean(reference)) / std::sqrt(1 / n + 1 / m);
}

}  // namespace channel
