// The variants of the reference chain, to be compared in one run.
#include <string>

#include "benchmark/benchmark.h"
#include "rate.hpp"
#include "reference_chain.hpp"

namespace bench {
namespace {

/// `BER` is to be about `reference_ber`: whoever is fast by doing another job shows it here.
void reference_chain(benchmark::State& state, const ReferenceVariant& variant) {
  constexpr int bits = 64;
  const auto chain = variant.make();
  chain->run(100);  // the peak tracker begins at zero
  ReferenceChain::Tally all;
  for (auto _ : state) {
    const auto part = chain->run(bits);
    all.bits += part.bits;
    all.errors += part.errors;
    all.samples += part.samples;
  }
  report(state, static_cast<double>(all.samples) / static_cast<double>(state.iterations()));
  state.counters["BER"] = static_cast<double>(all.errors) / static_cast<double>(all.bits);
}

const bool registered = [] {
  for (const ReferenceVariant& variant : reference_variants())
    benchmark::RegisterBenchmark((std::string("reference_chain/") + variant.name).c_str(),
                                 reference_chain, variant)
        ->Unit(benchmark::kMillisecond);
  return true;
}();

}  // namespace
}  // namespace bench
