#pragma once
// The loop over samples, the same for one trial as float and for eight as Lanes8: everything fused,
// nothing virtual, no buffer but the noise of a block. Only the kernels include it.
#include <array>
#include <cstdint>

#include "channel/chain_kernel.hpp"
#include "channel/keyed_carrier.hpp"
#include "channel/receiver_module.hpp"
#include "dsp/lanes.hpp"
#include "dsp/normal.hpp"

namespace channel {

/// Normals in blocks, so that their long dependency chains overlap.
template <class T>
class WhiteNoise {
 public:
  static constexpr int block = 64;

  void seed(int lane, const std::array<std::uint32_t, 4>& words) { source_.seed(lane, words); }

  T operator()() {
    if (next_ == block) refill();
    return normals_[next_++];
  }

 private:
  void refill() {
    dsp::NormalSource<T> source = source_;
    for (int i = 0; i < block; i += 2) {
      const auto [x, y] = source();
      normals_[i] = x;
      normals_[i + 1] = y;
    }
    source_ = source;
    next_ = 0;
  }

  dsp::NormalSource<T> source_;
  T normals_[block];
  int next_ = block;
};

/// The probe that looks at nothing and costs nothing.
struct NoProbe {
  template <class T>
  void operator()(T, const ModuleTaps<T>&) const {}
};

template <class T, class Probe>
void run_chain(const ChainKernelInput& in, Probe probe) {
  KeyedCarrier<T> carrier(*in.carrier);
  WhiteNoise<T> noise;
  ReceiverModule<T> module(*in.module);
  for (int i = 0; i < dsp::lanes<T>; ++i) {
    carrier.load(i, {in.lane[i].bursts, in.lane[i].n_bursts}, in.lane[i].carrier_phase);
    noise.seed(i, in.lane[i].noise_seed);
  }
  const T dark(in.noise_dark), lit(in.noise_lit);
  dsp::Mask<T> pin(true);
  for (std::int64_t n = 0; n < in.samples;) {
    const auto left = in.samples - n;
    const int wanted = left < WhiteNoise<T>::block ? static_cast<int>(left) : WhiteNoise<T>::block;
    const int length = carrier.begin_block(n, wanted);
    for (int i = 0; i < length; ++i) {
      const auto light = carrier(i);
      const T x = dsp::fused(noise(), dsp::choose(light.lit, lit, dark), light.irradiance);
      const dsp::Mask<T> now = module(x);
      if (dsp::any(now ^ pin)) in.on_flip(in.context, n + i + 1, dsp::bits(now ^ pin));
      pin = now;
      probe(x, module.taps());
    }
    n += length;
  }
}

}  // namespace channel
