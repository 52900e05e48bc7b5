// Each stage of the chain by itself, eight trials at once, for x86-64-v3 (see CMakeLists.txt). A
// stage alone waits for its own last result, so the parts cost more than the whole, in which their
// waits overlap.
#include <array>
#include <random>

#include "benchmark/benchmark.h"
#include "channel/chain_loop.hpp"
#include "rate.hpp"

namespace bench {
namespace {

using channel::ModuleDesign;
using dsp::Lanes8;

using channel::block;
constexpr int repeats = 16;
constexpr double samples_per_block = double{block} * dsp::lanes<Lanes8>;
constexpr dsp::Hertz sample_rate(1e6);

using Block = std::array<Lanes8, block>;

template <class Source>
Source seeded() {
  Source source;
  for (std::uint32_t i = 0; i < 8; ++i)
    source.seed(static_cast<int>(i), {i + 1, 2 * i + 3, 7 * i + 5, 11 * i + 7});
  return source;
}

/// White noise about as strong as the threshold: every branchless choice is taken now and then.
Block noise(float deviation) {
  std::mt19937 random(1);
  std::normal_distribution<float> normal(0, deviation);
  Block x;
  for (Lanes8& sample : x)
    for (int i = 0; i < 8; ++i) dsp::set_lane(sample, i, normal(random));
  return x;
}

ModuleDesign module_design() {
  return channel::design_module(channel::ModuleData{}, dsp::WattsPerSquareMetre(0.6), sample_rate);
}

channel::DemodulatorDesignOf<Lanes8> demodulator() {
  return channel::in_all_lanes<Lanes8>(module_design()).demodulator;
}

/// Runs `stage(x)` over the block again and again; every result is used.
template <class Stage>
void run(benchmark::State& state, Stage stage, const Block& x) {
  for (auto _ : state) {
    auto sum = stage(x[0]);
    for (int i = 0; i < repeats; ++i)
      for (const Lanes8& sample : x) sum = sum ^ stage(sample);
    benchmark::DoNotOptimize(sum);
  }
  report(state, repeats * samples_per_block);
}

void xoshiro_word(benchmark::State& state) {
  run(
      state, [words = seeded<dsp::Xoshiro<Lanes8>>()](Lanes8) mutable { return words(); }, Block{});
}
BENCHMARK(xoshiro_word);

void normals(benchmark::State& state) {
  auto source = seeded<dsp::NormalSource<Lanes8>>();
  Block x;
  for (auto _ : state) {
    source.fill(x.data(), block);
    benchmark::DoNotOptimize(x);
  }
  report(state, samples_per_block);
}
BENCHMARK(normals);

/// Light onto a block of noise, one burst a lane, begun before it.
void light(benchmark::State& state, double off) {
  const channel::CarrierDesign design{
      .step = 253403070, .cycles = 0.059f, .duty = 0.5f, .amplitude = 1.0f};
  const channel::Burst burst{-1.5, off};
  channel::KeyedCarrier<Lanes8> carrier(design);
  Block x = noise(1);
  for (auto _ : state) {
    for (int lane = 0; lane < 8; ++lane) carrier.load(lane, {&burst, 1}, 12345);
    channel::add_light(carrier, Lanes8(0.5f), Lanes8(0.5f), 0, x.data(), block);
    benchmark::DoNotOptimize(x);
  }
  report(state, samples_per_block);
}
BENCHMARK_CAPTURE(light, lit, 300.0);
BENCHMARK_CAPTURE(light, dark, -1.0);

void band_pass(benchmark::State& state) {
  channel::BandPass<Lanes8> filter(channel::in_all_lanes<Lanes8>(module_design()).band_pass);
  run(
      state, [filter](Lanes8 x) mutable { return dsp::to_bits(filter(x)); }, noise(1));
}
BENCHMARK(band_pass);

void follower_comparators_hold(benchmark::State& state) {
  const ModuleDesign d = module_design();
  run(
      state,
      [=, follower = channel::PeakFollower<Lanes8>(d.atc_fraction, d.atc_decay),
       signal = channel::PulseHold<Lanes8>(demodulator()),
       activity = channel::PulseHold<Lanes8>(demodulator())](Lanes8 u) mutable {
        const Lanes8 following = follower(u);
        return signal(u > dsp::larger(Lanes8(d.threshold), following)) +
               activity(u > dsp::larger(Lanes8(d.threshold * d.agc.margin), following));
      },
      noise(2 * d.threshold));
}
BENCHMARK(follower_comparators_hold);

void integrator(benchmark::State& state) {
  run(
      state,
      [stage = channel::PulseIntegrator<Lanes8>(demodulator()), sample = demodulator().sample](
          Lanes8 x) mutable { return stage(dsp::kept(x > Lanes8(0.0f), sample)); },
      noise(1));
}
BENCHMARK(integrator);

/// A tick comes once a carrier cycle: a sample's share is this over `samples_per_tick`, 17.
void slow_agc_tick(benchmark::State& state) {
  run(
      state,
      [stage = channel::SlowAgc<Lanes8>(channel::in_all_lanes<Lanes8>(module_design()).agc)](
          Lanes8 x) mutable {
        return dsp::to_bits(stage(dsp::choose(x > Lanes8(0.0f), Lanes8(17.0f), Lanes8(0.0f))));
      },
      noise(1));
}
BENCHMARK(slow_agc_tick);

void receiver_module(benchmark::State& state) {
  const ModuleDesign d = module_design();
  channel::ReceiverModule<Lanes8> module(channel::in_all_lanes<Lanes8>(d));
  const Block x = noise(10 * d.threshold);
  std::array<std::uint8_t, block> pins;
  for (auto _ : state) {
    channel::receive(module, x.data(), block, pins.data(), channel::NoProbe{});
    benchmark::DoNotOptimize(pins);
  }
  report(state, samples_per_block);
}
BENCHMARK(receiver_module);

}  // namespace
}  // namespace bench
