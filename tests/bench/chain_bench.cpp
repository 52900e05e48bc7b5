// The chain as the program runs it, from the LED's wire to the tally, at one operating point: the
// default scenario at 2.2 m, where some frames fail.
#include <algorithm>
#include <vector>

#include "benchmark/benchmark.h"
#include "protocol/uart_receivers.hpp"
#include "rate.hpp"
#include "sim/link/link.hpp"
#include "sim/link_experiment/link_measurement.hpp"
#include "sim/loading/load_scenario.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/trial/trial.hpp"

namespace bench {
namespace {

sim::Link link() {
  const auto scenario = sim::parse_scenario("", "bench.toml", {"receiver.range_m=2.2"},
                                            {COSYS_SOURCE_DIR "/scenarios"});
  return sim::make_link(sim::point_scenario(scenario, {}));
}

/// What some trials send.
struct Group {
  std::vector<sim::Transmission> sent;
  std::vector<channel::ChainInput> inputs;
  double samples = 0, longest = 0;  // of all trials together, and of one

  Group(const sim::Link& link, std::uint32_t n) {
    for (std::uint32_t i = 0; i < n; ++i) sent.push_back(transmit(link, i));
    for (std::uint32_t i = 0; i < n; ++i) {
      inputs.push_back(chain_input(link, i, sent[i]));
      const double own = dsp::cycles(sent[i].line.end(), link.chain.sample_rate);
      samples += own;
      longest = std::max(longest, own);
    }
  }
};

/// `used`: the share of the kernel's samples that are some trial's; the rest are those of lanes
/// whose trial is over before the group's longest.
void propagate_by(benchmark::State& state, channel::InstructionSet set) {
  const sim::Link at = link();
  const int trials = channel::trials_at_once(set);
  const Group group(at, static_cast<std::uint32_t>(trials));
  for (auto _ : state)
    benchmark::DoNotOptimize(channel::propagate(at.chain, group.inputs, nullptr, set));
  report(state, group.samples);
  state.counters["used"] = group.samples / (trials * group.longest);
}
void propagate(benchmark::State& state) { propagate_by(state, channel::InstructionSet::best); }
BENCHMARK(propagate)->Unit(benchmark::kMillisecond);
void propagate_v3(benchmark::State& state) { propagate_by(state, channel::InstructionSet::v3); }
BENCHMARK(propagate_v3)->Unit(benchmark::kMillisecond);

void propagate_alone(benchmark::State& state) {
  const sim::Link at = link();
  const Group group(at, 1);
  for (auto _ : state)
    benchmark::DoNotOptimize(channel::propagate_alone(at.chain, group.inputs.front()));
  report(state, group.samples);
}
BENCHMARK(propagate_alone)->Unit(benchmark::kMillisecond);

/// One trial's pin; its cost is spread over the samples that the chain spent on it.
void uart(benchmark::State& state, const char* name) {
  const sim::Link at = link();
  const Group group(at, 1);
  const auto pin = channel::propagate_alone(at.chain, group.inputs.front());
  const protocol::UartReceiver* receiver = protocol::find_uart_receiver(name);
  for (auto _ : state) benchmark::DoNotOptimize(receiver->receive(pin, at.receiver_baud, 0.5));
  report(state, group.samples);
}
BENCHMARK_CAPTURE(uart, atmega, "atmega")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(uart, mid_bit, "mid-bit")->Unit(benchmark::kMicrosecond);

/// Whole trials, messages to tally, as many as run at once.
void run_groups(benchmark::State& state) {
  const sim::Link at = link();
  double samples = 0;
  for (auto _ : state) {
    samples = 0;
    for (const auto& group : sim::run_groups(at, 0, channel::trials_at_once()))
      samples += static_cast<double>(group.n_samples);
  }
  report(state, samples);
}
BENCHMARK(run_groups)->Unit(benchmark::kMillisecond);

/// 1024 frames by the thread pool, against the clock on the wall.
void engine(benchmark::State& state) {
  const sim::Link at = link();
  const sim::StopRule stop{.max_frames = 1024, .max_frame_errors = 0};
  double samples = 0;
  for (auto _ : state) {
    const auto result = run_point(at, stop, {.threads = static_cast<int>(state.range(0))});
    samples = static_cast<double>(result.n_samples);
  }
  report(state, samples);
}
BENCHMARK(engine)->ArgName("threads")->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace bench
