#pragma once
// The loop over carrier cycles, the same for one trial as float and for many as lanes. Only the
// kernels include it, and who computes one trial alone.
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "channel/envelope_kernel.hpp"
#include "channel/envelope_receiver.hpp"
#include "dsp/lanes.hpp"
#include "dsp/normal.hpp"

namespace channel {

template <class T>
class EnvelopeLoop {
 public:
  explicit EnvelopeLoop(const EnvelopeKernelInput& in)
      : in_(in), design_(in_all_lanes<T>(*in.design)), band_pass_(design_), demodulator_(design_) {
    for (int i = 0; i < dsp::lanes<T>; ++i) noise_.seed(i, in.lane[i].noise_seed);
  }

  void run() {
    for (std::size_t i = 0; i < in_.n_stretches; ++i) run_stretch(i);
  }

 private:
  static constexpr int block = envelope_block;
  static_assert(block % steps_per_tick == 0);

  void run_stretch(std::size_t stretch) {
    begin(stretch);
    T xy[2 * block];
    Envelope<T> envelope[block];
    const std::int32_t steps = in_.steps[stretch];
    for (std::int32_t first = 0; first < steps && !in_.stopped(in_.context); first += block) {
      noise_.fill(xy, 2 * block);
      fill(first, xy, envelope);
      demodulate(stretch, first, envelope);
    }
  }

  void begin(std::size_t stretch) {
    T rest{};
    for (int i = 0; i < dsp::lanes<T>; ++i) {
      const EnvelopeStretch& s = in_.lane[i].stretches[stretch];
      edge_[i] = s.edges;
      end_[i] = s.edges + s.n_edges;
      dsp::set_lane(lit_, i, 0.0f);
      dsp::set_lane(rest, i, s.rest);
    }
    set_light();
    demodulator_.rest(rest);
    const auto [x, y] = noise_();
    band_pass_.set(design_.resting.re * x,
                   dsp::fused(design_.resting.cross, x, design_.resting.im * y));
  }

  void set_light() {
    const auto lit = lit_ > T(0.5f);
    const EnvelopeNoise<T>&on = design_.lit, &off = design_.dark;
    band_pass_.set_light(dsp::choose(lit, design_.peak, T(0.0f)),
                         {dsp::choose(lit, on.re, off.re), dsp::choose(lit, on.cross, off.cross),
                          dsp::choose(lit, on.im, off.im)});
  }

  std::int32_t next_edge(std::int32_t end) const {
    for (int i = 0; i < dsp::lanes<T>; ++i)
      if (edge_[i] != end_[i]) end = std::min(end, edge_[i]->step);
    return end;
  }

  Envelope<T> edge_step(std::int32_t step, T x, T y) {
    T re(0.0f), im(0.0f);
    for (int i = 0; i < dsp::lanes<T>; ++i)
      for (; edge_[i] != end_[i] && edge_[i]->step <= step; ++edge_[i]) {
        dsp::set_lane(re, i, dsp::lane(re, i) + edge_[i]->re);
        dsp::set_lane(im, i, dsp::lane(im, i) + edge_[i]->im);
        dsp::set_lane(lit_, i, edge_[i]->lit ? 1.0f : 0.0f);
      }
    set_light();
    band_pass_.add_edge(re, im);
    return band_pass_(x, y);
  }

  void fill(std::int32_t first, const T* xy, Envelope<T>* envelope) {
    band_pass_.settle();
    for (int i = 0; i < block; ++i) {
      const int edge = next_edge(first + block) - first;
      EnvelopeBandPass<T> local = band_pass_;
      for (; i < edge; ++i) envelope[i] = local(xy[2 * i], xy[2 * i + 1]);
      band_pass_ = local;
      if (i < block) envelope[i] = edge_step(first + i, xy[2 * i], xy[2 * i + 1]);
    }
  }

  void demodulate(std::size_t stretch, std::int32_t first, const Envelope<T>* envelope) {
    T edge[block];
    dsp::LaneBits<T> light[block];
    EnvelopeDemodulator<T> local = demodulator_;
    for (int i = 0; i < block; i += steps_per_tick) local(envelope + i, light + i, edge + i);
    demodulator_ = local;
    report_edges(stretch, first, light, edge);
  }

  void report_edges(std::size_t stretch, std::int32_t first, const dsp::LaneBits<T>* light,
                    const T* edge) {
    for (int i = 0; i < block; ++i) {
      std::uint32_t edges = light[i] ^ before_;
      before_ = light[i];
      for (int lane = 0; edges != 0; ++lane, edges >>= 1)
        if ((edges & 1) != 0)
          in_.on_edge(in_.context, lane, stretch,
                      first + i + static_cast<double>(dsp::lane(edge[i], lane)));
    }
  }

  const EnvelopeKernelInput& in_;
  EnvelopeDesignOf<T> design_;
  EnvelopeBandPass<T> band_pass_;
  EnvelopeDemodulator<T> demodulator_;
  dsp::NormalSource<T> noise_;
  const EnvelopeEdge* edge_[dsp::lanes<T>] = {};
  const EnvelopeEdge* end_[dsp::lanes<T>] = {};
  T lit_ = T(0.0f);  // 1 where the light is on
  dsp::LaneBits<T> before_ = 0;
};

}  // namespace channel
