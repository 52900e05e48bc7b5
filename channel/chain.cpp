#include "channel/chain.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "channel/bursts.hpp"
#include "channel/chain_loop.hpp"
#include "channel/kernel_choice.hpp"
#include "channel/kernel_disturbances.hpp"
#include "channel/lane_parts.hpp"
#include "channel/noise.hpp"

namespace channel {
namespace {

/// No noise at all would leave the filters to decay into denormal numbers, 17 times as slow.
constexpr double least_noise_mw_per_m2 = 1e-12;

std::int64_t samples_of(const dsp::LogicTrace& drive, dsp::Hertz sample_rate) {
  return static_cast<std::int64_t>(std::ceil(dsp::cycles(drive.end(), sample_rate)));
}

/// Pins being written; an edge past a trial's own end is not that trial's.
class PinWriter {
 public:
  PinWriter(std::span<const ChainInput> inputs, dsp::Hertz sample_rate,
            const std::atomic<bool>* stop)
      : rate_(sample_rate), stop_(stop) {
    for (const ChainInput& input : inputs) {
      pins_.emplace_back(true, input.drive->end());
      last_.push_back(samples_of(*input.drive, sample_rate));
    }
  }

  static void write(void* self, std::int64_t sample, std::uint32_t lanes) {
    static_cast<PinWriter*>(self)->write(sample, lanes);
  }
  static bool stopped(void* self) {
    const std::atomic<bool>* stop = static_cast<PinWriter*>(self)->stop_;
    return stop != nullptr && stop->load(std::memory_order_relaxed);
  }
  std::vector<dsp::LogicTrace> take() { return std::move(pins_); }

 private:
  void write(std::int64_t sample, std::uint32_t lanes) {
    for (std::size_t i = 0; i < pins_.size(); ++i) {
      if ((lanes >> i & 1) == 0 || sample > last_[i]) continue;
      pins_[i].add_edge(dsp::Seconds(static_cast<double>(sample) / rate_.value));
    }
  }

  dsp::Hertz rate_;
  const std::atomic<bool>* stop_;
  std::vector<dsp::LogicTrace> pins_;
  std::vector<std::int64_t> last_;
};

struct Recorder {
  static constexpr bool looks = true;
  Recording* into;
  void operator()(float irradiance, const ModuleTaps<float>& taps) const {
    into->irradiance.push_back(irradiance);
    into->band_pass.push_back(taps.band_pass);
    into->threshold.push_back(taps.threshold);
    into->integrator.push_back(taps.integrator);
    into->agc_gain.push_back(taps.agc_gain);
  }
};

/// Inputs of a group in the kernels' form, with the memory that they point to.
struct PreparedGroup {
  std::vector<std::vector<Burst>> bursts;
  KernelDisturbances disturbances;
  ChainKernelInput kernel;

  PreparedGroup(const ChainDesign& design, std::span<const ChainInput> inputs, PinWriter& pins) {
    kernel.carrier = &design.carrier;
    for (ChainKernelInput::Lane& lane : kernel.lane) lane.module = &design.module;
    kernel.noise_dark = design.noise_dark;
    kernel.noise_lit = design.noise_lit;
    kernel.on_edge = &PinWriter::write;
    kernel.stopped = &PinWriter::stopped;
    kernel.context = &pins;
    for (const ChainInput& input : inputs) {
      ChainKernelInput::Lane& lane = kernel.lane[bursts.size()];
      bursts.push_back(bursts_of(*input.drive, design.sample_rate));
      lane.bursts = bursts.back().data();
      lane.n_bursts = bursts.back().size();
      lane.carrier_phase = input.carrier_phase;
      lane.noise_seed = input.noise_seed;
      if (input.unit != nullptr) lane.module = input.unit;
      lane.noise_windows = input.noise_windows.data();
      lane.n_noise_windows = input.noise_windows.size();
      lane.margin_windows = input.margin_windows.data();
      lane.n_margin_windows = input.margin_windows.size();
      kernel.samples = std::max(kernel.samples, samples_of(*input.drive, design.sample_rate));
      disturbances.add_lane(design.disturbances, input.disturbances, design.sample_rate);
    }
    disturbances.show_to(kernel);
  }
};

constexpr Kernels<ChainKernelInput> chain_kernels{
    .baseline = run_lanes_baseline,
#ifdef COSYS_HAVE_X86
    .v3 = run_lanes_v3,
    .v4 = run_lanes_v4,
#endif
};

/// Runs the kernel, under a clock if there is one.
void run_chains(ChainKernelInput& input, std::size_t trials, InstructionSet set,
                StageClock* clock) {
  if (clock != nullptr) {
    input.on_stage = &StageClock::lap;
    input.stage_context = clock;
    clock->start();
  }
  run_narrowest(chain_kernels, input, trials, set);
}

std::vector<dsp::Seconds> ends_of(std::span<const ChainInput> inputs) {
  std::vector<dsp::Seconds> ends;
  for (const ChainInput& input : inputs) ends.push_back(input.drive->end());
  return ends;
}

}  // namespace

ChainDesign design_chain(const ModuleData& module, const LightSettings& light,
                         dsp::Hertz sample_rate) {
  assert(sample_rate > 2.0 * light.carrier && light.duty > 0 && light.duty < 1);
  const dsp::Amperes dark = photocurrent(module, light.ambient);
  const dsp::Amperes lit =
      photocurrent(module, noisy_light(module, light.ambient, light.signal * light.duty));
  const auto deviation = [&](dsp::Amperes mean) {
    const double density = noise_density(module, mean);
    return static_cast<float>(
        std::max(least_noise_mw_per_m2,
                 light.noise_scale * sample_deviation_mw_per_m2(module, density, sample_rate)));
  };
  return {.sample_rate = sample_rate,
          .carrier = design_carrier(light.signal, light.carrier, light.duty, sample_rate),
          .module = design_module(module, light.ambient, sample_rate),
          .noise_dark = deviation(dark),
          .noise_lit = deviation(lit)};
}

ModuleDesign design_unit(const ModuleData& unit, dsp::WattsPerSquareMetre ambient,
                         const ChainDesign& chain) {
  ModuleDesign design = design_module(unit, ambient, chain.sample_rate);
  design.agc.samples_per_tick = chain.module.agc.samples_per_tick;  // one for all lanes
  return design;
}

std::vector<dsp::LogicTrace> propagate(const ChainDesign& design,
                                       std::span<const ChainInput> inputs,
                                       const std::atomic<bool>* stop, InstructionSet set,
                                       StageClock* clock) {
  return pins_by_length(inputs, set, [&](std::span<const std::size_t> which) {
    const std::vector<ChainInput> part = picked(inputs, which);
    PinWriter pins(part, design.sample_rate, stop);
    PreparedGroup group(design, part, pins);
    run_chains(group.kernel, part.size(), set, clock);
    return pins.take();
  });
}

dsp::LogicTrace propagate_alone(const ChainDesign& design, const ChainInput& input,
                                Recording* recording) {
  const std::span<const ChainInput> inputs(&input, 1);
  PinWriter pins(inputs, design.sample_rate, nullptr);
  const PreparedGroup group(design, inputs, pins);
  if (recording != nullptr) {
    run_chain<float>(group.kernel, Recorder{recording});
  } else {
    run_chain<float>(group.kernel, NoProbe{});
  }
  return pins.take().front();
}

std::vector<dsp::LogicTrace> detect(const ChainDesign& design, const IdealDesign& receiver,
                                    std::span<const ChainInput> inputs,
                                    std::span<const BitSlots> slots, const std::atomic<bool>* stop,
                                    InstructionSet set, StageClock* clock) {
  assert(slots.size() == inputs.size());
  return pins_by_length(inputs, set, [&](std::span<const std::size_t> which) {
    const std::vector<ChainInput> part = picked(inputs, which);
    const std::vector<BitSlots> part_slots = picked(slots, which);
    PinWriter unused(part, design.sample_rate, stop);
    SlotWriter pins(receiver, part_slots, design.sample_rate, stop);
    PreparedGroup group(design, part, unused);
    pins.attach_to(group.kernel);
    run_chains(group.kernel, part.size(), set, clock);
    return pins.take(ends_of(part));
  });
}

dsp::LogicTrace detect_alone(const ChainDesign& design, const IdealDesign& receiver,
                             const ChainInput& input, const BitSlots& slots, Recording* recording) {
  const std::span<const ChainInput> inputs(&input, 1);
  PinWriter unused(inputs, design.sample_rate, nullptr);
  SlotWriter pins(receiver, {&slots, 1}, design.sample_rate, nullptr);
  PreparedGroup group(design, inputs, unused);
  pins.attach_to(group.kernel);
  if (recording != nullptr) {
    run_correlator<float>(group.kernel, Recorder{recording});
  } else {
    run_correlator<float>(group.kernel, NoProbe{});
  }
  return pins.take(ends_of(inputs)).front();
}

}  // namespace channel
