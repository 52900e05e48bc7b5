#pragma once
// What every benchmark prints: `sample`, the time that one sample of one trial takes, and `rate`,
// samples a second. Of CPU time, or of wall-clock time where a benchmark asks for that.
#include "benchmark/benchmark.h"

namespace bench {

/// To be called behind the loop; `samples` counts those of all lanes, of one iteration.
inline void report(benchmark::State& state, double samples) {
  using benchmark::Counter;
  const double all = samples * static_cast<double>(state.iterations());
  state.counters["sample"] = Counter(all, Counter::kIsRate | Counter::kInvert);
  state.counters["rate"] = Counter(all, Counter::kIsRate);
}

/// The same of bits: `bit` is the time of one.
inline void report_bits(benchmark::State& state, double bits) {
  using benchmark::Counter;
  const double all = bits * static_cast<double>(state.iterations());
  state.counters["bit"] = Counter(all, Counter::kIsRate | Counter::kInvert);
  state.counters["rate"] = Counter(all, Counter::kIsRate);
}

}  // namespace bench
