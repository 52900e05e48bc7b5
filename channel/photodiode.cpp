#include "channel/photodiode.hpp"

#include <cmath>
#include <numbers>

#include "channel/emitter.hpp"
#include "channel/noise.hpp"

namespace channel {
dsp::Amperes photocurrent(const PhotodiodeData& data, dsp::WattsPerSquareMetre irradiance) {
  return dsp::Amperes(data.responsivity_a_per_w * data.area_mm2 * 1e-6 * irradiance.value);
}

double relative_sensitivity(const PhotodiodeData& data, dsp::Radians off_axis) {
  if (off_axis.value > std::numbers::pi / 2) return 0;
  return std::pow(std::cos(off_axis.value), cosine_power(dsp::degrees(data.half_angle_deg)));
}

double shot_noise_density(const PhotodiodeData& data, dsp::Amperes photocurrent) {
  return shot_noise_density(photocurrent + dsp::Amperes(data.dark_current_na * 1e-9));
}

double noise_equivalent_power(const PhotodiodeData& data) {
  return std::sqrt(shot_noise_density(data, {})) / data.responsivity_a_per_w;
}

}  // namespace channel
