// The ideal link as one decision a bit: the kernel on seeds made before, the same with the trials'
// seeds drawn, and the engine from seeds to counts. Frames are `IND 011111 OK`, 170 bits; argument:
// Eb/N0 in dB. BER is printed to show that the bits are those of theory.
#include <array>
#include <bit>
#include <string>
#include <vector>

#include "benchmark/benchmark.h"
#include "rate.hpp"
#include "sim/link/link.hpp"
#include "sim/link_experiment/link_measurement.hpp"
#include "sim/loading/load_scenario.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/trial/trial.hpp"

namespace bench {
namespace {

constexpr std::uint32_t group = channel::lanes_per_group;
using Seeds = std::array<channel::NoiseSeed, group>;

sim::Link link(const char* receiver, std::int64_t db) {
  const auto scenario = sim::parse_scenario(
      "", "bench.toml",
      {std::string("receiver.module=") + receiver, "receiver.ebn0_db=" + std::to_string(db),
       "simulation.warmup_messages=0", "simulation.fidelity=decision"},
      {COSYS_SOURCE_DIR "/scenarios"});
  return sim::make_link(sim::point_scenario(scenario, {}));
}

Seeds seeds_of(const sim::Link& at, std::uint32_t first) {
  Seeds seeds;
  for (std::uint32_t i = 0; i < group; ++i) seeds[i] = noise_seed(at, first + i);
  return seeds;
}

int wrong_bits(const channel::WrongBits& wrong) {
  int n = 0;
  for (const std::uint8_t lanes : wrong) n += std::popcount(lanes);
  return n;
}

double bits_of(const sim::Link& at) {
  return static_cast<double>(at.decisions->bits.bits.size() * group);
}

/// So many groups in turn that no branch of one is remembered.
void decision_link(benchmark::State& state, const char* receiver) {
  const sim::Link at = link(receiver, state.range(0));
  std::vector<Seeds> seeds;
  for (std::uint32_t i = 0; i < 4096; ++i) seeds.push_back(seeds_of(at, i * group));
  double wrong = 0;
  for (const Seeds& each : seeds) wrong += wrong_bits(decide(at.decisions->bits, each));
  std::size_t next = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(decide(at.decisions->bits, seeds[next++ % seeds.size()]));
  report_bits(state, bits_of(at));
  state.counters["BER"] = wrong / (bits_of(at) * static_cast<double>(seeds.size()));
}
BENCHMARK_CAPTURE(decision_link, coherent, "ideal-coherent")->Arg(0)->Arg(4)->Arg(10)->Arg(14);
BENCHMARK_CAPTURE(decision_link, noncoherent, "ideal-noncoherent")->Arg(10);

void decision_link_seeded(benchmark::State& state) {
  const sim::Link at = link("ideal-coherent", state.range(0));
  std::uint32_t first = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(decide(at.decisions->bits, seeds_of(at, first)));
    first += group;
  }
  report_bits(state, bits_of(at));
}
BENCHMARK(decision_link_seeded)->Arg(10)->Arg(14);

/// From seeds to counts by the thread pool, against the clock on the wall.
void decision_engine(benchmark::State& state) {
  const sim::Link at = link("ideal-coherent", state.range(0));
  const sim::StopRule stop{.max_frames = state.range(0) > 12 ? 400000u : 40000u,
                           .max_frame_errors = 0};
  for (auto _ : state) run_point(at, stop, {.threads = static_cast<int>(state.range(1))});
  report_bits(state, bits_of(at) / group * static_cast<double>(stop.max_frames));
}
BENCHMARK(decision_engine)
    ->ArgNames({"dB", "threads"})
    ->ArgsProduct({{10, 14}, {1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace bench
