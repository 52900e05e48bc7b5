#include "sim/link/matched.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/link/theory.hpp"

namespace sim {
namespace {

/// Density of the noise with the carrier on, A^2/Hz.
double density_at(const channel::ModuleData& module, const channel::LightSettings& light,
                  dsp::WattsPerSquareMetre signal) {
  const auto noisy = channel::noisy_light(module, light.ambient, signal * light.duty);
  return channel::noise_density(module, channel::photocurrent(module, noisy)) * light.noise_scale *
         light.noise_scale;
}

/// Energy of a bit, on average, over the square of the peak irradiance in W/m2: A^2 s.
double bit_energy(const channel::ModuleData& module, const channel::LightSettings& light,
                  dsp::Hertz baud) {
  const double amplitude = channel::fundamental_of(
      channel::photocurrent(module, dsp::WattsPerSquareMetre(1)).value, light.duty);
  return amplitude * amplitude / 4 / baud.value;
}

bool is_coherent(const channel::ModuleData& module) { return module.detector == "coherent"; }

/// In standard deviations of the correlator's output.
double threshold_of(const channel::ModuleData& module, double ebn0) {
  if (module.detector_threshold > 0) return module.detector_threshold * lit_amplitude(ebn0);
  return is_coherent(module) ? lit_amplitude(ebn0) / 2 : optimum_envelope_threshold(ebn0);
}

double ber_of(const channel::ModuleData& module, double ebn0, const OokThreshold& threshold) {
  return is_coherent(module) ? coherent_ook_ber(ebn0, threshold)
                             : noncoherent_ook_ber(ebn0, threshold);
}

}  // namespace

// Eb/N0 = e E^2 / (d + g E), E being the irradiance: a quadratic in it.
dsp::WattsPerSquareMetre signal_for_ebn0(const channel::ModuleData& module,
                                         const channel::LightSettings& light, dsp::Hertz baud,
                                         double ebn0_db) {
  const double wanted = std::pow(10, ebn0_db / 10) / bit_energy(module, light, baud);
  const double dark = density_at(module, light, dsp::WattsPerSquareMetre(0));
  const double growth = density_at(module, light, dsp::WattsPerSquareMetre(1)) - dark;
  const double half = wanted * growth / 2;
  return dsp::WattsPerSquareMetre(half + std::sqrt(half * half + wanted * dark));
}

double ebn0_of(const channel::ModuleData& module, const channel::LightSettings& light,
               dsp::Hertz baud) {
  return bit_energy(module, light, baud) * light.signal.value * light.signal.value /
         density_at(module, light, light.signal);
}

// Eb/N0 from the numbers that the samples are made with, so that the theory is theirs.
std::optional<MatchedReceiver> matched_receiver(const channel::ModuleData& module,
                                                const channel::LightSettings& light,
                                                const channel::ChainDesign& chain, dsp::Hertz baud,
                                                const protocol::Bytes& bytes) {
  if (!channel::is_matched(module)) return std::nullopt;
  const channel::CorrelatorOutput output = channel::correlator_output(chain, light, baud);
  const double deviation = output.deviation_dark;
  const double ebn0 = std::pow(output.amplitude / deviation / 2, 2);
  const double threshold = threshold_of(module, ebn0);
  using enum channel::IdealDesign::Statistic;
  return MatchedReceiver{.design = {.statistic = is_coherent(module) ? in_phase : envelope,
                                    .threshold = threshold * deviation,
                                    .delay = dsp::period(baud)},
                         .output = output,
                         .ber = chain.disturbances.empty()
                                    ? ber_of(module, ebn0, {threshold, lit_share(bytes)})
                                    : std::numeric_limits<double>::quiet_NaN()};
}

double lit_share(const protocol::Bytes& bytes) {
  const std::vector<bool> levels = protocol::line_bits(bytes);
  const auto lit = std::ranges::count(levels, false);
  return static_cast<double>(lit) / static_cast<double>(levels.size());
}

}  // namespace sim
