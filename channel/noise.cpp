#include "channel/noise.hpp"

#include <cmath>
#include <numbers>

namespace channel {
namespace {

constexpr double elementary_charge = 1.602176634e-19;  // C, SI 2019
constexpr double boltzmann = 1.380649e-23;             // J/K, SI 2019

double amperes_per_mw_per_m2(const ModuleData& data) {
  return data.responsivity_a_per_w * data.aperture_mm2 * 1e-6 * 1e-3;
}

}  // namespace

dsp::Amperes photocurrent(const ModuleData& data, dsp::WattsPerSquareMetre irradiance) {
  return dsp::Amperes(irradiance.value * 1e3 * amperes_per_mw_per_m2(data));
}

dsp::WattsPerSquareMetre noisy_light(const ModuleData& data, dsp::WattsPerSquareMetre ambient,
                                     dsp::WattsPerSquareMetre signal) {
  return is_matched(data) ? ambient : ambient + signal;
}

double shot_noise_density(dsp::Amperes mean) { return 2 * elementary_charge * mean.value; }

double thermal_noise_density(double kelvin, double ohm) { return 4 * boltzmann * kelvin / ohm; }

double noise_density(const ModuleData& data, dsp::Amperes mean) {
  return shot_noise_density(mean) + thermal_noise_density(data.temperature_k, data.feedback_ohm);
}

dsp::Hertz noise_bandwidth(const ModuleData& data) {
  return dsp::Hertz(std::numbers::pi / 2 * data.centre_hz / data.q);
}

double sample_deviation_mw_per_m2(const ModuleData& data, double density, dsp::Hertz sample_rate) {
  return std::sqrt(density * sample_rate.value / 2) / amperes_per_mw_per_m2(data);
}

}  // namespace channel
