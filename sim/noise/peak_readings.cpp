#include "sim/noise/peak_readings.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>

namespace sim {
namespace {

/// A response is followed until its envelope has decayed to this share.
constexpr double least_response = 1e-5;
constexpr std::size_t longest_response = 1 << 15;  // samples

using Responses = std::array<std::vector<double>, 3>;

/// Front end and band-pass (channel::ReceiverModule::filtered) after a sample of 1: the output in
/// thirds of each sample from then on.
Responses impulse_responses(const channel::ModuleDesign& module) {
  const channel::BandPassDesign& filter = module.band_pass;
  Responses responses;
  double light = 0, u = 0, v = 0, x = 1, largest = 0, largest_state = 0;
  const auto after = [&](const channel::BandPassStep<float>& step) {
    return static_cast<double>(step.u) * u + static_cast<double>(step.v) * v +
           static_cast<double>(step.x) * light;
  };
  do {
    light += static_cast<double>(module.front_end) * (x - light);
    const double next_u = after(filter.output), next_v = after(filter.integral);
    responses[0].push_back(after(filter.third));
    responses[1].push_back(after(filter.two_thirds));
    responses[2].push_back(next_u);
    u = next_u;
    v = next_v;
    x = 0;
    largest_state = std::hypot(u, v);
    largest = std::max(largest, largest_state);
  } while (largest_state > least_response * largest && responses[2].size() < longest_response);
  return responses;
}

/// Phase of the response to a cosine, in cycles.
double phase_of(const std::vector<double>& response, double cycles_per_sample) {
  std::complex<double> sum;
  for (std::size_t i = 0; i < response.size(); ++i)
    sum += response[i] *
           std::polar(1.0, -2 * std::numbers::pi * cycles_per_sample * static_cast<double>(i));
  return std::arg(sum) / (2 * std::numbers::pi);
}

}  // namespace

PeakReadings::PeakReadings(const channel::ModuleDesign& module,
                           const channel::CarrierDesign& carrier, std::uint32_t phase)
    : cycles_per_sample_(carrier.step * 0x1p-32) {
  const Responses responses = impulse_responses(module);
  const double turns = phase * 0x1p-32 + phase_of(responses[2], cycles_per_sample_);
  offset_ = 1 - turns / cycles_per_sample_;
  for (std::size_t i = 0; i < thirds_.size(); ++i) {
    const Eigen::Map<const Eigen::VectorXd> response(
        responses[i].data(), static_cast<Eigen::Index>(responses[i].size()));
    thirds_[i].deviation = response.norm();
    for (Eigen::Index k = response.size(); k-- > 0;)
      thirds_[i].against.push_back(static_cast<float>(-response[k] / response.norm()));
  }
}

std::int64_t PeakReadings::first_from(double time) const {
  return static_cast<std::int64_t>(std::ceil((time - offset_) * cycles_per_sample_));
}

double PeakReadings::time_of(std::int64_t peak) const {
  return offset_ + static_cast<double>(peak) / cycles_per_sample_;
}

NoiseReading PeakReadings::reading(std::int64_t peak) const {
  const Instant at = instant_of(peak);
  return {at.sample + 1 - length(), thirds_[static_cast<std::size_t>(at.third)].against};
}

PeakReadings::Instant PeakReadings::instant_of(std::int64_t peak) const {
  const auto thirds = std::llround(3 * time_of(peak));  // from the start of sample 0
  const std::int64_t sample = (thirds + 2) / 3 - 1;
  return {sample, static_cast<int>(thirds - 3 * sample - 1)};
}

const PeakReadings::Third& PeakReadings::third_of(std::int64_t peak) const {
  return thirds_[static_cast<std::size_t>(instant_of(peak).third)];
}

}  // namespace sim
