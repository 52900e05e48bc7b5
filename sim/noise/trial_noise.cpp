#include "sim/noise/trial_noise.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cassert>

#include "sim/noise/addressed_normals.hpp"

namespace sim {
namespace {

using Floats = Eigen::Map<const Eigen::VectorXf>;

Floats floats(const float* from, std::int64_t n) { return {from, n}; }

/// What a reading is a mixture of; where the factor is 0 there are no coefficients.
struct Row {
  const float* coefficients;
  float factor;
};

std::array<Row, 2> rows_of(const NoiseReading& r) {
  const float* const cosine = r.coefficients.data();
  return {Row{cosine, r.factor}, Row{cosine + r.coefficients.size(), r.sine_factor}};
}

}  // namespace

double covariance(const NoiseReading& a, const NoiseReading& b) {
  const auto size = [](const NoiseReading& r) {
    return static_cast<std::int64_t>(r.coefficients.size());
  };
  const std::int64_t from = std::max(a.first, b.first);
  const std::int64_t n = std::min(a.first + size(a), b.first + size(b)) - from;
  if (n <= 0) return 0;
  double sum = 0;
  for (const Row& of_a : rows_of(a))
    for (const Row& of_b : rows_of(b)) {
      if (of_a.factor == 0 || of_b.factor == 0) continue;
      sum += static_cast<double>(of_a.factor * of_b.factor) *
             static_cast<double>(floats(of_a.coefficients + (from - a.first), n)
                                     .dot(floats(of_b.coefficients + (from - b.first), n)));
    }
  return sum;
}

TrialNoise::TrialNoise(const std::vector<Stretch>& stretches, const dsp::RandomAddress& draws) {
  std::int64_t n = 0;
  for (const Stretch& stretch : stretches) n += stretch.n;
  normals_ = addressed_normals(draws, static_cast<std::size_t>(n));
  const float* next = normals_.data();
  for (const Stretch& stretch : stretches) {
    windows_.push_back({stretch.first, stretch.n, next});
    next += stretch.n;
  }
}

double TrialNoise::value(const NoiseReading& reading) const {
  const auto n = static_cast<std::int64_t>(reading.coefficients.size());
  const Floats noise = floats(normals_.data() + place_of(reading), n);
  double sum = 0;
  for (const Row& row : rows_of(reading))
    if (row.factor != 0)
      sum += static_cast<double>(row.factor * noise.dot(floats(row.coefficients, n)));
  return sum;
}

void TrialNoise::add(const NoiseReading& reading, double factor) {
  const auto n = static_cast<std::int64_t>(reading.coefficients.size());
  Eigen::Map<Eigen::VectorXf> noise(normals_.data() + place_of(reading), n);
  for (const Row& row : rows_of(reading))
    if (row.factor != 0)
      noise += static_cast<float>(factor) * row.factor * floats(row.coefficients, n);
}

std::size_t TrialNoise::place_of(const NoiseReading& reading) const {
  const auto window = std::ranges::find_if(windows_, [&](const channel::NoiseWindow& w) {
    return w.first <= reading.first &&
           reading.first + static_cast<std::int64_t>(reading.coefficients.size()) <= w.first + w.n;
  });
  assert(window != windows_.end());
  return static_cast<std::size_t>(window->normals - normals_.data() + reading.first -
                                  window->first);
}

}  // namespace sim
