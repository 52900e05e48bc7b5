// A module's envelope, one step a carrier cycle, where chain_bench.cpp has its waveform: the
// default scenario at 2.2 m. Rates are bits of simulated time, pauses included; `step` is the time
// that one step of one trial takes.
#include <vector>

#include "benchmark/benchmark.h"
#include "rate.hpp"
#include "sim/link/link.hpp"
#include "sim/link_experiment/link_measurement.hpp"
#include "sim/loading/load_scenario.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/trial/envelope_trial.hpp"
#include "sim/trial/trial.hpp"

namespace bench {
namespace {

sim::Link link(const std::vector<std::string>& more = {}) {
  std::vector<std::string> set{"receiver.range_m=2.2", "simulation.fidelity=envelope"};
  set.insert(set.end(), more.begin(), more.end());
  const auto scenario = sim::parse_scenario("", "bench.toml", set, {COSYS_SOURCE_DIR "/scenarios"});
  return sim::make_link(sim::point_scenario(scenario, {}));
}

/// As many trials as run at once, from the LED's wire to the pin.
void envelope_pins(benchmark::State& state, const sim::Link& at) {
  std::vector<sim::Transmission> sent;
  double bits = 0, steps = 0;
  for (int i = 0; i < channel::trials_at_once(); ++i) {
    sent.push_back(transmit(at, static_cast<std::uint32_t>(i)));
    bits += dsp::cycles(sent.back().line.end(), at.device_baud);
    steps += dsp::cycles(sent.back().line.end(), at.envelope->chain.carrier);
  }
  for (auto _ : state) benchmark::DoNotOptimize(sim::envelope_pins(at, 0, sent, nullptr));
  report_bits(state, bits);
  using benchmark::Counter;
  const double all = steps * static_cast<double>(state.iterations());
  state.counters["step"] = Counter(all, Counter::kIsRate | Counter::kInvert);
}

void envelope(benchmark::State& state) { envelope_pins(state, link()); }
BENCHMARK(envelope)->Unit(benchmark::kMillisecond);

/// Nothing is left out: a message is behind the other.
void envelope_dense(benchmark::State& state) {
  envelope_pins(state, link({"device.interval_min_ms=0", "device.interval_max_ms=0"}));
}
BENCHMARK(envelope_dense)->Unit(benchmark::kMillisecond);

/// From seeds to counts by the thread pool, against the clock on the wall.
void envelope_engine(benchmark::State& state) {
  const sim::Link at = link();
  const sim::StopRule stop{.max_frames = 256, .max_frame_errors = 0};
  double bits = 0;
  for (auto _ : state) {
    const auto result = run_point(at, stop, {.threads = static_cast<int>(state.range(0))});
    bits = result.simulated_s * at.device_baud.value;
  }
  report_bits(state, bits);
}
BENCHMARK(envelope_engine)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace bench
