#include "channel/light_meter.hpp"

#include <algorithm>
#include <cmath>

#include "channel/noise.hpp"

namespace channel {
namespace {

double volts(const LightMeter& meter, dsp::WattsPerSquareMetre irradiance) {
  return meter.feedback_ohm * photocurrent(meter.photodiode, irradiance).value;
}

/// Cycles of light from phase 0 to phase p: the integral of the square wave.
double lit_cycles(double p, double duty) {
  const double whole = std::floor(p);
  return whole * duty + std::min(p - whole, duty);
}

/// The carrier's share of light in the aperture of each sample in turn.
class LitShare {
 public:
  LitShare(const LightMeter& meter, const MeteredLight& light, const MeterWindow& window)
      : aperture_(meter.aperture),
        cycles_(light.carrier.value / meter.sample_rate_hz),
        duty_(light.duty),
        window_(window) {}

  /// To be called for samples 0, 1, ... in order.
  double operator()(std::size_t sample) {
    const double begin = static_cast<double>(sample), end = begin + aperture_;
    const auto& bursts = window_.bursts;
    while (next_ < bursts.size() && bursts[next_].off <= begin) ++next_;
    double lit = 0;
    for (std::size_t i = next_; i < bursts.size() && bursts[i].on < end; ++i)
      lit += lit_until(std::min(bursts[i].off, end)) - lit_until(std::max(bursts[i].on, begin));
    return lit / (cycles_ * aperture_);
  }

 private:
  double lit_until(double sample) const {
    return lit_cycles(window_.phase + cycles_ * sample, duty_);
  }

  double aperture_, cycles_, duty_;
  const MeterWindow& window_;
  std::size_t next_ = 0;  // the first burst that is not over
};

}  // namespace

MeterWindow steady_window(std::size_t samples, double phase) {
  return {samples, phase, {{0, static_cast<double>(samples)}}};
}

std::vector<double> noiseless_volts(const LightMeter& meter, const MeteredLight& light,
                                    const MeterWindow& window) {
  const double signal = volts(meter, light.signal);
  const double steady =
      volts(meter, light.ambient) + meter.feedback_ohm * meter.photodiode.dark_current_na * 1e-9;
  LitShare lit_share(meter, light, window);
  std::vector<double> samples(window.samples);
  for (std::size_t i = 0; i < window.samples; ++i) samples[i] = steady + signal * lit_share(i);
  return samples;
}

double noise_volts(const LightMeter& meter, double mean_volts) {
  const dsp::Amperes light(mean_volts / meter.feedback_ohm -
                           meter.photodiode.dark_current_na * 1e-9);
  const double density = shot_noise_density(meter.photodiode, light) +
                         thermal_noise_density(meter.temperature_k, meter.feedback_ohm);
  const double aperture = meter.aperture / meter.sample_rate_hz;
  return meter.noise_scale * meter.feedback_ohm * std::sqrt(density / (2 * aperture));
}

double adc_step(const LightMeter& meter) { return std::ldexp(meter.full_scale_v, -meter.adc_bits); }

double converted(const LightMeter& meter, double volts) {
  const double top = std::ldexp(1.0, meter.adc_bits) - 1;
  return std::clamp(std::round(volts / adc_step(meter)), 0.0, top) * adc_step(meter);
}

bool is_clipped(const LightMeter& meter, double converted_volts) {
  return converted_volts <= 0 || converted_volts >= meter.full_scale_v - adc_step(meter);
}

}  // namespace channel
