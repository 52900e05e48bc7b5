#include "sim/trial_noise.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cassert>

#include "channel/normals.hpp"

namespace sim {
namespace {

using Floats = Eigen::Map<const Eigen::VectorXf>;

Floats floats(const float* from, std::int64_t n) { return {from, n}; }

}  // namespace

double covariance(const NoiseReading& a, const NoiseReading& b) {
  const auto size = [](const NoiseReading& r) {
    return static_cast<std::int64_t>(r.coefficients.size());
  };
  const std::int64_t from = std::max(a.first, b.first);
  const std::int64_t n = std::min(a.first + size(a), b.first + size(b)) - from;
  if (n <= 0) return 0;
  return static_cast<double>(floats(a.coefficients.data() + (from - a.first), n)
                                 .dot(floats(b.coefficients.data() + (from - b.first), n)));
}

TrialNoise::TrialNoise(const std::vector<Stretch>& stretches, const dsp::RandomAddress& draws) {
  std::int64_t n = 0;
  for (const Stretch& stretch : stretches) n += stretch.n;
  channel::StreamSeeds seeds;
  for (std::size_t i = 0; i < seeds.size(); ++i)
    seeds[i] = draws.block(static_cast<std::uint32_t>(i));
  normals_ = channel::draw_normals(seeds, static_cast<std::size_t>(n));
  const float* next = normals_.data();
  for (const Stretch& stretch : stretches) {
    windows_.push_back({stretch.first, stretch.n, next});
    next += stretch.n;
  }
}

double TrialNoise::value(const NoiseReading& reading) const {
  const auto n = static_cast<std::int64_t>(reading.coefficients.size());
  return static_cast<double>(
      floats(normals_.data() + place_of(reading), n).dot(floats(reading.coefficients.data(), n)));
}

void TrialNoise::add(const NoiseReading& reading, double factor) {
  const auto n = static_cast<std::int64_t>(reading.coefficients.size());
  Eigen::Map<Eigen::VectorXf>(normals_.data() + place_of(reading), n) +=
      static_cast<float>(factor) * floats(reading.coefficients.data(), n);
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
