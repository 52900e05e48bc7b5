#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "channel/envelope.hpp"
#include "channel/ideal_receiver.hpp"
#include "channel/keyed_carrier.hpp"
#include "channel/noise.hpp"
#include "channel/receiver_module.hpp"

namespace channel {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

/// Noise does not pass this, in standard deviations, as far as a gain is concerned: of a cycle's
/// peak one in four million does, exp(-5.5^2 / 2).
constexpr double unseen_deviations = 5.5;

/// The resonator of channel/band_pass.hpp, whose output is the real part of gain * z, where
/// z' = pole z + input.
struct Resonator {
  double centre, q;  // rad/s
  Complex pole, gain;

  explicit Resonator(const ModuleData& data) : centre(2 * pi * data.centre_hz), q(data.q) {
    const double decay = centre / (2 * q), turn = std::sqrt(centre * centre - decay * decay);
    pole = {-decay, turn};
    gain = centre / q * Complex(1, decay / turn);
  }
  Complex response(double hz) const {
    const Complex s(0, 2 * pi * hz), damped = s * centre / q;
    return damped / (centre * centre + s * s + damped);
  }
};

double droop(double cycles) { return std::sin(pi * cycles) / (pi * cycles); }

Complex front_end(double share, double cycles) {
  return share / (1.0 - (1 - share) * std::exp(Complex(0, -2 * pi * cycles)));
}

/// The carrier's fundamental behind the waveform's band-pass, of unit peak: of the two means over a
/// sample one is made up for at the carrier, the other and the front end's gain at the centre.
Complex seen_fundamental(const Resonator& resonator, const ModuleData& data,
                         const LightSettings& light, const ChainDesign& waveform) {
  const double fs = waveform.sample_rate.value, f = light.carrier.value / fs;
  const double f0 = data.centre_hz / fs;
  const auto share = static_cast<double>(waveform.module.front_end);
  return fundamental_of(1, light.duty) * (droop(f) / droop(f0)) *
         (front_end(share, f) / std::abs(front_end(share, f0))) *
         resonator.response(light.carrier.value);
}

/// Mean over carrier cycles of the largest output that the waveform's comparator sees in each, in
/// light that has been on for long. Some harmonics and the grid of samples are in it.
double seen_peak(const ChainDesign& waveform, double q) {
  const double a_cycle = 1 / static_cast<double>(waveform.carrier.cycles);
  const int settled = static_cast<int>(5 * q * a_cycle);
  const int samples = settled + static_cast<int>(500 * a_cycle);
  ReceiverModule<float> receiver(waveform.module);
  KeyedCarrier<float> light(waveform.carrier);
  double sum = 0, peak = 0, cycles = 0;
  for (int i = 0; i < samples; ++i) {
    const auto seen = static_cast<double>(receiver.filtered(light.steady(dsp::Mask<float>(true))));
    if (seen < 0 && peak > 0) {
      if (i >= settled) sum += peak, ++cycles;
      peak = 0;
    }
    peak = std::max(peak, seen);
  }
  return sum / cycles;
}

/// Share of the noise's variance behind the band-pass that the front end takes from it, gains at f0
/// being equal: the integral of |resonator|^2 / (1 + (f/f1)^2) over all f, in closed form.
double front_end_loss(const ModuleData& data) {
  const double ratio = data.front_end_hz / data.centre_hz, loss = ratio / data.q;
  return loss / (1 + ratio * ratio + loss);
}

/// Share of a step's noise that its peak sees. The front end is slower than white noise: what it
/// takes is missing from the newest.
double seen_share(const ModuleData& data, const Resonator& resonator, double cycle) {
  const double newest = 1 - std::exp(2 * resonator.pole.real() * cycle);
  return std::sqrt(1 - front_end_loss(data) / newest);
}

EnvelopeNoise<float> cholesky(double power, Complex pseudo) {
  const double re = std::sqrt((power + pseudo.real()) / 2);
  const double cross = pseudo.imag() / 2 / re;
  const double im = std::sqrt(std::max(0.0, (power - pseudo.real()) / 2 - cross * cross));
  return {static_cast<float>(re), static_cast<float>(cross), static_cast<float>(im)};
}

/// What white noise of a two-sided density adds to the free response in a time.
EnvelopeNoise<float> noise_of(const Resonator& r, double density, double time) {
  const double faded = std::exp(2 * r.pole.real() * time);
  const Complex turned = std::exp(2.0 * r.pole * time);
  return cholesky(density * std::norm(r.gain) * (faded - 1) / (2 * r.pole.real()),
                  density * r.gain * r.gain * (turned - 1.0) / (2.0 * r.pole));
}

/// Amplitude of the carrier's fundamental behind a band-pass without front end and samples.
double ideal_fundamental(const Resonator& resonator, const LightSettings& light) {
  return fundamental_of(1, light.duty) * std::abs(resonator.response(light.carrier.value));
}

/// Of white samples, mW2/m4/Hz, two-sided.
double density_of(float sample_deviation, dsp::Hertz sample_rate) {
  return std::pow(static_cast<double>(sample_deviation), 2) / sample_rate.value;
}

/// By how much the gain must be up for noise not to be seen as activity, dB.
double unseen_db(const ModuleData& module, const LightSettings& light, const ChainDesign& waveform,
                 double margin) {
  const double ratio = comparator_level(module, light.ambient) / noise_deviation(module, waveform);
  return std::max(0.0, 20 * std::log10(unseen_deviations / (ratio * margin)));
}

/// Until the gain is down from where noise is not seen: three times as long as without noise, which
/// holds it up (chosen, not derived).
double settling_steps(const SlowAgcDesign& agc, double least_db) {
  constexpr double filters = 200;  // the band-pass forgets: 20 of its time constants at Q = 30
  if (least_db == 0 || agc.release == 0) return filters;
  return filters + static_cast<double>(agc.hold) + 3 * least_db / static_cast<double>(agc.release);
}

/// Ring-down to the threshold, hold and integrator, and 64 more for noise.
double ending_steps(const EnvelopeDesign& d, std::complex<double> pole, dsp::Hertz rate) {
  const double overdrive = std::max(1.0, static_cast<double>(d.peak / d.threshold));
  return std::log(overdrive) * rate.value / -pole.real() +
         static_cast<double>(d.hold + d.integrator) + 64;
}

SlowAgcDesign design_agc(const ModuleData& module, dsp::Hertz steps) {
  SlowAgcDesign agc = design_slow_agc(module, steps);
  agc.samples_per_tick = steps_per_tick;
  return agc;
}

EnvelopeDesign design_receiver(const ModuleData& module, const LightSettings& light,
                               const ChainDesign& waveform) {
  const auto f = [](double x) { return static_cast<float>(x); };
  const Resonator r(module);
  const double hz = light.carrier.value, cycle = 1 / hz;
  const double dark = density_of(waveform.noise_dark, waveform.sample_rate);
  const double lit = density_of(waveform.noise_lit, waveform.sample_rate);
  const Complex keep = std::exp(r.pole * cycle), drift = r.pole * cycle - Complex(0, 2 * pi);
  const double atc = 1 / (module.atc_release_ms * 1e-3 * hz);
  const double grid = hz / waveform.sample_rate.value / 3;  // a pulse on a grid of samples
  const SlowAgcDesign agc = design_agc(module, light.carrier);
  return {.keep_re = f(keep.real()),
          .keep_im = f(keep.imag()),
          .drift_re = f(drift.real()),
          .drift_im = f(drift.imag()),
          .seen = f(seen_share(module, r, cycle)),
          .dark = noise_of(r, dark, cycle),
          .lit = noise_of(r, lit, cycle),
          .resting = noise_of(r, dark, 1),
          .peak = f(seen_peak(waveform, module.q)),
          .threshold = f(comparator_level(module, light.ambient)),
          .atc_fraction = f(module.atc_fraction),
          .atc_decay = f(std::exp(-atc)),
          .atc_octaves = f(atc / std::numbers::ln2),
          .hold = f(module.comparator_hold_cycles * hz / module.centre_hz - grid),
          .integrator = f(module.integrator_cycles * hz / module.centre_hz),
          .agc = agc,
          .least_db = f(unseen_db(module, light, waveform, static_cast<double>(agc.margin)))};
}

}  // namespace

double noise_deviation(const ModuleData& module, const ChainDesign& waveform) {
  const double density = density_of(waveform.noise_dark, waveform.sample_rate);
  return std::sqrt(2 * density * noise_bandwidth(module).value);
}

EnvelopeChain design_envelope(const ModuleData& module, const LightSettings& light,
                              const ChainDesign& waveform) {
  const Resonator r(module);
  const Complex fundamental = seen_fundamental(r, module, light, waveform);
  const Complex input = front_end(static_cast<double>(waveform.module.front_end),
                                  light.carrier / waveform.sample_rate);
  const EnvelopeDesign design = design_receiver(module, light, waveform);
  return {.carrier = light.carrier,
          .duty = light.duty,
          .unit = {.design = design,
                   .pole = r.pole,
                   .gain = r.gain,
                   .irradiance = light.signal.value * 1e3 * std::abs(fundamental) /
                                 ideal_fundamental(r, light),
                   .peak_phase = light.duty / 2 - std::arg(fundamental) / (2 * pi),
                   .delay = dsp::Seconds(-std::arg(input) / (2 * pi * light.carrier.value)),
                   .settling = settling_steps(design.agc, static_cast<double>(design.least_db)),
                   .ending = ending_steps(design, r.pole, light.carrier)}};
}

}  // namespace channel
