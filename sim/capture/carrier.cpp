#include "sim/capture/carrier.hpp"

#include <algorithm>
#include <bit>

#include "dsp/spectrum.hpp"

namespace sim {
namespace {

using dsp::Hertz;

constexpr Hertz lowest_carrier{20e3}, half_band{1.5e3}, half_neighbourhood{7.5e3};
constexpr double least_contrast = 10, least_share_of_power = 0.003;
constexpr double bin_width_hz = 200;

/// The power-weighted mean frequency of the band around a bin.
Hertz centroid(const dsp::Spectrum& spectrum, Hertz around) {
  double power = 0, moment = 0;
  for (std::size_t i = 0; i < spectrum.frequency_hz.size(); ++i) {
    const double f = spectrum.frequency_hz[i];
    if (f < (around - half_band).value || f > (around + half_band).value) continue;
    power += spectrum.density[i];
    moment += f * spectrum.density[i];
  }
  return Hertz(moment / power);
}

bool stands_out(const dsp::Spectrum& spectrum, Hertz peak) {
  const Hertz top(spectrum.frequency_hz.back());
  const Hertz low = std::max(peak - half_neighbourhood, Hertz(0));
  const Hertz high = std::min(peak + half_neighbourhood, top);
  const double band = dsp::band_power(spectrum, peak - half_band, std::min(peak + half_band, top));
  const double around = dsp::band_power(spectrum, low, high) - band;
  const double all = dsp::band_power(spectrum, Hertz(0), top);
  const double width_ratio = (high - low - 2 * half_band) / (2 * half_band);
  return band > least_share_of_power * all && band * width_ratio > least_contrast * around;
}

}  // namespace

std::optional<Hertz> find_carrier(std::span<const float> samples, Hertz sample_rate) {
  if (samples.size() < 256 || sample_rate < 2.2 * lowest_carrier) return std::nullopt;
  const auto wanted = static_cast<std::size_t>(sample_rate.value / bin_width_hz);
  const dsp::Spectrum spectrum = dsp::welch(
      samples, sample_rate, std::clamp(std::bit_ceil(wanted), std::size_t{256}, samples.size()));
  const auto first = static_cast<std::ptrdiff_t>(
      std::ranges::lower_bound(spectrum.frequency_hz, lowest_carrier.value) -
      spectrum.frequency_hz.begin());
  const auto peak = std::max_element(spectrum.density.begin() + first, spectrum.density.end());
  if (peak == spectrum.density.end() || *peak <= 0) return std::nullopt;
  const auto bin = static_cast<std::size_t>(peak - spectrum.density.begin());
  const Hertz at(spectrum.frequency_hz[bin]);
  if (!stands_out(spectrum, at)) return std::nullopt;
  return centroid(spectrum, at);
}

}  // namespace sim
