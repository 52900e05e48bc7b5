#pragma once
// Light meter: photodiode, transimpedance resistor and ADC, and no demodulator: what sees the light
// itself. A sample is the mean of the photocurrent over the ADC's aperture, exact for a square
// carrier of any frequency, so a slow ADC sees the carrier aliased as a real one does. Nothing else
// filters: an ADC with a short aperture has the noise of the bandwidth 1 / (2 aperture) in each
// sample. Noise is white, from sample to sample independent, for apertures do not overlap.
#include <cstddef>
#include <vector>

#include "channel/keyed_carrier.hpp"
#include "channel/photodiode.hpp"
#include "dsp/units.hpp"

namespace channel {

struct LightMeter {
  PhotodiodeData photodiode;
  double feedback_ohm = 1e6;  // volts out for an ampere of photocurrent
  double temperature_k = 298.15;
  double sample_rate_hz = 200e3;
  double aperture = 1;      // share of the sample interval, above 0 to 1; 1: an integrating ADC
  int adc_bits = 12;        // 1..24
  double full_scale_v = 5;  // of the ADC's input, which begins at 0
  double noise_scale = 1;   // on the rms of all noise but the ADC's rounding
};

/// Light on the photodiode, what it loses off axis left out already.
struct MeteredLight {
  dsp::WattsPerSquareMetre signal;   // peak of the on/off wave
  dsp::WattsPerSquareMetre ambient;  // steady
  dsp::Hertz carrier{59e3};
  double duty = 0.5;  // of the carrier, above 0 to 1
};

/// What the light does while the meter looks.
struct MeterWindow {
  std::size_t samples = 0;
  double phase =
      0;  // of the carrier at the first sample's begin, in cycles; 0: the lit part begins
  std::vector<Burst> bursts = {};  // in samples from the window's begin, in order; none: dark
};

/// A window in which the carrier is on throughout.
MeterWindow steady_window(std::size_t samples, double phase);

/// Voltage at the ADC's input, noise left out, a value a sample: dark current, ambient and signal.
std::vector<double> noiseless_volts(const LightMeter& meter, const MeteredLight& light,
                                    const MeterWindow& window);

/// Standard deviation of a sample's noise in volts while the voltage is `mean_volts` on average:
/// shot noise of all of the current and thermal noise of the resistor, sqrt(density / (2
/// aperture)).
double noise_volts(const LightMeter& meter, double mean_volts);

/// A step of the ADC in volts.
double adc_step(const LightMeter& meter);

/// What the ADC gives for a voltage: the nearest step, from 0 to one step below full scale.
double converted(const LightMeter& meter, double volts);

/// Whether the ADC gives the same for all voltages beyond this one.
bool is_clipped(const LightMeter& meter, double converted_volts);

}  // namespace channel
