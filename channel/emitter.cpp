#include "channel/emitter.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace channel {
namespace {

double log_log(const Curve& curve, double at) {
  const auto above = std::upper_bound(curve.x.begin(), curve.x.end(), at);
  if (above == curve.x.end()) return curve.y.back();
  const auto i = static_cast<std::size_t>(above - curve.x.begin());
  const double share = std::log(at / curve.x[i - 1]) / std::log(curve.x[i] / curve.x[i - 1]);
  return curve.y[i - 1] * std::pow(curve.y[i] / curve.y[i - 1], share);
}

double temperature_factor(const EmitterData& emitter, double celsius) {
  const Curve& curve = emitter.relative_intensity_against_temperature;
  return curve.empty() ? 1 : curve(celsius) / curve(emitter_reference_celsius);
}

}  // namespace

dsp::WattsPerSteradian axial_intensity(const EmitterData& emitter, dsp::Amperes current,
                                       double celsius) {
  const Curve& curve = emitter.intensity_mw_per_sr;
  assert(!curve.empty() && curve.x.size() == curve.y.size());
  assert(curve.x.front() > 0 && current.value >= 0);
  const double ma = current.value * 1e3;
  const double mw_per_sr =
      ma < curve.x.front() ? curve.y.front() * ma / curve.x.front() : log_log(curve, ma);
  return dsp::WattsPerSteradian(mw_per_sr * 1e-3 * temperature_factor(emitter, celsius));
}

dsp::Metres wavelength(const EmitterData& emitter, double celsius) {
  const double shift = emitter.wavelength_nm_per_k * (celsius - emitter_reference_celsius);
  return dsp::Metres((emitter.wavelength_nm + shift) * 1e-9);
}

double cosine_power(dsp::Radians half_angle) {
  assert(half_angle.value > 0 && half_angle.value < std::numbers::pi / 2);
  return std::log(0.5) / std::log(std::cos(half_angle.value));
}

double relative_intensity(const EmitterData& emitter, dsp::Radians off_axis) {
  if (off_axis.value > std::numbers::pi / 2) return 0;
  if (!emitter.pattern.empty()) return emitter.pattern(dsp::in_degrees(off_axis));
  const double m = cosine_power(dsp::degrees(emitter.half_angle_deg));
  return std::pow(std::cos(off_axis.value), m);
}

}  // namespace channel
