#pragma once
// The loop over samples, the same for one trial as float and for eight as Lanes8: block by block
// noise, then light, then the module, fused. Three short loops, since the state of each stays in
// registers; that of all in one does not (tests/bench). Only the kernels include it.
#include <algorithm>
#include <cstdint>

#include "channel/chain_kernel.hpp"
#include "channel/keyed_carrier.hpp"
#include "channel/receiver_module.hpp"
#include "dsp/lanes.hpp"
#include "dsp/normal.hpp"

namespace channel {

/// The probe that looks at nothing and costs nothing.
struct NoProbe {
  template <class T>
  void operator()(T, const ModuleTaps<T>&) const {}
};

/// Samples made at a time: few enough to stay in the first-level cache.
constexpr int block = 256;

/// Turns white noise into irradiance: noise of the lit or the dark strength, and the light.
template <class T>
void add_light(KeyedCarrier<T>& carrier, T dark, T lit, std::int64_t first, T* x, int n) {
  for (int done = 0; done < n;) {
    const int length = carrier.begin_block(first + done, n - done);
    T* const part = x + done;
    if (carrier.dark(length)) {
      for (int i = 0; i < length; ++i) part[i] = dsp::fused(part[i], dark, T(0.0f));
      carrier.skip(length);
    } else {
      for (int i = 0; i < length; ++i) {
        const auto light = carrier(i);
        part[i] = dsp::fused(part[i], dsp::choose(light.lit, lit, dark), light.irradiance);
      }
    }
    done += length;
  }
}

template <class T, class Probe>
void run_chain(const ChainKernelInput& in, Probe probe) {
  KeyedCarrier<T> carrier(*in.carrier);
  dsp::NormalSource<T> noise;
  ReceiverModule<T> module(*in.module);
  for (int i = 0; i < dsp::lanes<T>; ++i) {
    carrier.load(i, {in.lane[i].bursts, in.lane[i].n_bursts}, in.lane[i].carrier_phase);
    noise.seed(i, in.lane[i].noise_seed);
  }
  T x[block];
  std::uint8_t pins[block];  // bit i: lane i
  auto before = static_cast<std::uint8_t>(dsp::bits(dsp::Mask<T>(true)));
  for (std::int64_t first = 0; first < in.samples && !in.stopped(in.context); first += block) {
    const int length = static_cast<int>(std::min<std::int64_t>(block, in.samples - first));
    noise.fill(x, block);
    add_light(carrier, T(in.noise_dark), T(in.noise_lit), first, x, length);
    for (int i = 0; i < length; ++i) {
      pins[i] = static_cast<std::uint8_t>(dsp::bits(module(x[i])));
      probe(x[i], module.taps());
    }
    for (int i = 0; i < length; ++i) {
      const std::uint32_t flips = pins[i] ^ before;
      if (flips != 0) in.on_flip(in.context, first + i + 1, flips);
      before = pins[i];
    }
  }
}

}  // namespace channel
