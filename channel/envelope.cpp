#include "channel/envelope.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "channel/envelope_kernel.hpp"
#include "channel/envelope_loop.hpp"
#include "channel/lane_parts.hpp"
#include "channel/noise.hpp"

namespace channel {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

/// Noise does not pass this, in standard deviations, as far as a gain is concerned.
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
Complex fundamental_of(const Resonator& resonator, const ModuleData& data,
                       const LightSettings& light, const ChainDesign& waveform) {
  const double fs = waveform.sample_rate.value, f = light.carrier.value / fs;
  const double f0 = data.centre_hz / fs;
  const auto share = static_cast<double>(waveform.module.front_end);
  return 2 * std::sin(pi * light.duty) / pi * (droop(f) / droop(f0)) *
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

/// State of the band-pass's pole in steady light of unit peak.
class SteadyState {
 public:
  SteadyState(Complex pole, double cycle, double duty)
      : pole_(pole), lit_(duty * cycle), cycle_(cycle), driven_(1.0 / pole) {
    const Complex lit = std::exp(pole * lit_), dark = std::exp(pole * (cycle - lit_));
    begin_ = dark * (lit - 1.0) * driven_ / (1.0 - lit * dark);
    end_ = lit * (begin_ + driven_) - driven_;
  }

  /// At a phase of the carrier, in cycles, and left alone from there for a time.
  Complex operator()(double phase, double time) const {
    const double t = phase * cycle_;
    if (t >= lit_) return std::exp(pole_ * (t - lit_ + time)) * end_;
    const Complex left = std::exp(pole_ * time);
    return left * (std::exp(pole_ * t) * (begin_ + driven_) - driven_);
  }

 private:
  Complex pole_;
  double lit_, cycle_;
  Complex driven_, begin_, end_;  // what light adds for ever; where light begins, and ends
};

double fraction(double x) { return x - std::floor(x); }

/// A trial in steps.
class StepClock {
 public:
  StepClock(const EnvelopeChain& chain, std::uint32_t carrier_phase)
      : hz_(chain.carrier.value), first_(chain.unit.peak_phase - carrier_phase * 0x1p-32) {}
  double seconds(double step) const { return (step + first_) / hz_; }
  std::int64_t at_or_after(dsp::Seconds t) const {
    return static_cast<std::int64_t>(std::ceil(t.value * hz_ - first_));
  }

 private:
  double hz_, first_;
};

/// One lane's stretches in the kernels' form, and its pin.
class EnvelopeLane {
 public:
  EnvelopeLane(const EnvelopeChain& chain, const EnvelopeInput& input,
               std::span<const std::int32_t> steps)
      : clock_(chain, input.carrier_phase), pin_(true, input.drive->end()) {
    std::int64_t done = 0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      begins_.push_back(clock_.at_or_after(input.begins[i]));
      rests_.push_back(begins_.back() - done);
      assert(rests_.back() >= 0);
      done = begins_.back() + steps[i];
    }
    add_edges(chain, input, steps);
    for (std::size_t i = 0; i < steps.size(); ++i)
      stretches_.push_back({edges_[i].data(), edges_[i].size(), static_cast<float>(rests_[i])});
  }

  const EnvelopeStretch* stretches() const { return stretches_.data(); }
  /// The pin changes so many steps behind the begin of a stretch, unless the trial is over by then.
  void flip(std::size_t stretch, double step) {
    const double last = pin_.flips().empty() ? 0 : pin_.flips().back().value;
    const double at = clock_.seconds(static_cast<double>(begins_[stretch]) + step - 0.5);
    if (at <= pin_.end().value) pin_.flip_at(dsp::Seconds(std::max(last, at)));
  }
  dsp::LogicTrace take() { return std::move(pin_); }

 private:
  void add_edges(const EnvelopeChain& chain, const EnvelopeInput& input,
                 std::span<const std::int32_t> steps) {
    const SteadyState steady(chain.unit.pole, 1 / chain.carrier.value, chain.duty);
    edges_.resize(steps.size());
    bool lit = !input.drive->initial();
    std::size_t stretch = 0;
    for (const dsp::Seconds flip : input.drive->flips()) {
      lit = !lit;
      const dsp::Seconds behind = flip + chain.unit.delay;
      const std::int64_t step = clock_.at_or_after(behind);
      while (stretch + 1 < steps.size() && step >= begins_[stretch + 1]) ++stretch;
      assert(step >= begins_[stretch]);
      const double phase =
          fraction(flip.value * chain.carrier.value + input.carrier_phase * 0x1p-32);
      const double until = clock_.seconds(static_cast<double>(step) - 1) - behind.value;
      const Complex free =
          (lit ? -1.0 : 1.0) * chain.unit.irradiance * chain.unit.gain * steady(phase, until);
      edges_[stretch].push_back({.step = static_cast<std::int32_t>(step - begins_[stretch]),
                                 .re = static_cast<float>(free.real()),
                                 .im = static_cast<float>(free.imag()),
                                 .lit = lit});
    }
  }

  StepClock clock_;
  dsp::LogicTrace pin_;
  std::vector<std::int64_t> begins_, rests_;
  std::vector<std::vector<EnvelopeEdge>> edges_;
  std::vector<EnvelopeStretch> stretches_;
};

/// Inputs of a group in the kernels' form, with the memory that they point to.
class EnvelopeGroup {
 public:
  EnvelopeGroup(const EnvelopeChain& chain, std::span<const EnvelopeInput> inputs,
                std::span<const std::int32_t> steps, const std::atomic<bool>* stop)
      : stop_(stop) {
    lanes_.reserve(inputs.size());
    for (const EnvelopeInput& input : inputs) lanes_.emplace_back(chain, input, steps);
    for (std::size_t i = 0; i < most_lanes; ++i) {
      const std::size_t from = std::min(i, inputs.size() - 1);  // an idle lane repeats the last
      kernel_.lane[i] = {lanes_[from].stretches(), inputs[from].noise_seed};
    }
    kernel_.design = &chain.unit.design;
    kernel_.steps = steps.data();
    kernel_.n_stretches = steps.size();
    kernel_.on_flip = &EnvelopeGroup::flip;
    kernel_.stopped = &EnvelopeGroup::stopped;
    kernel_.context = this;
  }
  EnvelopeGroup(const EnvelopeGroup&) = delete;
  EnvelopeGroup& operator=(const EnvelopeGroup&) = delete;

  const EnvelopeKernelInput& kernel() const { return kernel_; }
  std::vector<dsp::LogicTrace> take() {
    std::vector<dsp::LogicTrace> pins;
    for (EnvelopeLane& lane : lanes_) pins.push_back(lane.take());
    return pins;
  }

 private:
  static void flip(void* self, int lane, std::size_t stretch, double step) {
    auto& lanes = static_cast<EnvelopeGroup*>(self)->lanes_;
    const auto i = static_cast<std::size_t>(lane);
    if (i < lanes.size()) lanes[i].flip(stretch, step);
  }
  static bool stopped(void* self) {
    const std::atomic<bool>* stop = static_cast<EnvelopeGroup*>(self)->stop_;
    return stop != nullptr && stop->load(std::memory_order_relaxed);
  }

  std::vector<EnvelopeLane> lanes_;
  const std::atomic<bool>* stop_;
  EnvelopeKernelInput kernel_;
};

/// The narrowest kernel that has lanes for so many trials.
void run_kernel(const EnvelopeKernelInput& input, [[maybe_unused]] std::size_t trials,
                [[maybe_unused]] InstructionSet set) {
#ifdef COSYS_HAVE_X86
  if (trials > lanes_per_group) return run_envelopes_v4(input);
  if (runs_v3(set)) return run_envelopes_v3(input);
#endif
  run_envelopes_baseline(input);
}

/// Amplitude of the carrier's fundamental behind a band-pass without front end and samples.
double ideal_fundamental(const Resonator& resonator, const LightSettings& light) {
  return 2 * std::sin(pi * light.duty) / pi * std::abs(resonator.response(light.carrier.value));
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

/// Until the gain is down from where noise is not seen: three times as long, as noise holds it up.
double settling_steps(const SlowAgcDesign& agc, double least_db) {
  constexpr double filters = 200;
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
  const Complex fundamental = fundamental_of(r, module, light, waveform);
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

std::vector<dsp::LogicTrace> propagate_envelopes(const EnvelopeChain& chain,
                                                 std::span<const EnvelopeInput> inputs,
                                                 std::span<const std::int32_t> steps,
                                                 const std::atomic<bool>* stop,
                                                 InstructionSet set) {
  return pins_in_parts(inputs.size(), set, [&](std::size_t first, std::size_t n) {
    EnvelopeGroup group(chain, inputs.subspan(first, n), steps, stop);
    run_kernel(group.kernel(), n, set);
    return group.take();
  });
}

dsp::LogicTrace propagate_envelope(const EnvelopeChain& chain, const EnvelopeInput& input,
                                   std::span<const std::int32_t> steps) {
  EnvelopeGroup group(chain, {&input, 1}, steps, nullptr);
  EnvelopeLoop<float>(group.kernel()).run();
  return group.take().front();
}

}  // namespace channel
