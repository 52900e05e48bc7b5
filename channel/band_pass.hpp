#pragma once
// The one resonator of a receiver module: |H| = 1 / sqrt(1 + Q^2 (f/f0 - f0/f)^2), which is
// Vishay 82459 rev 1.8 Fig. 5 within 0.004 at Q = 10. Discretised exactly for an input that is
// constant over each sample (matrix exponential), so the response does not warp with the rate.
#include "dsp/lanes.hpp"
#include "dsp/units.hpp"

namespace channel {

/// What the output is a part of a sample later: of itself, of its integral and of the input.
template <class T>
struct BandPassStep {
  T u, v, x;
};

template <class T>
void set_lane(BandPassStep<T>& all, int lane, const BandPassStep<float>& one) {
  dsp::set_lane(all.u, lane, one.u);
  dsp::set_lane(all.v, lane, one.v);
  dsp::set_lane(all.x, lane, one.x);
}

template <class T>
struct BandPassDesignOf {
  BandPassStep<T> output, integral;   // over a whole sample
  BandPassStep<T> third, two_thirds;  // the output on the way
};
using BandPassDesign = BandPassDesignOf<float>;

template <class T>
void set_lane(BandPassDesignOf<T>& all, int lane, const BandPassDesign& one) {
  set_lane(all.output, lane, one.output);
  set_lane(all.integral, lane, one.integral);
  set_lane(all.third, lane, one.third);
  set_lane(all.two_thirds, lane, one.two_thirds);
}

/// Needs q > 0.5 and a sample rate above 2 f0. Makes up for the droop at f0 of an input that is
/// held for a sample, and for `input_gain`, what a stage before this one leaves of a signal at f0.
BandPassDesign design_band_pass(dsp::Hertz centre, double q, dsp::Hertz sample_rate,
                                double input_gain = 1);

template <class T>
class BandPass {
 public:
  explicit BandPass(const BandPassDesignOf<T>& design) : design_(design) {}

  /// One sample in; the output at its end.
  T operator()(T x) {
    const T u = after(design_.output, x);
    peak_ = dsp::larger(u, dsp::larger(after(design_.third, x), after(design_.two_thirds, x)));
    v_ = after(design_.integral, x);
    return u_ = u;
  }

  T output() const { return u_; }

  /// Largest output in the last sample. A comparator watches all the time: of a wave that it sees
  /// at sample instants alone it misses up to (pi f / rate)^2 / 2 of each peak.
  T peak() const { return peak_; }

 private:
  T after(const BandPassStep<T>& step, T x) const {
    return dsp::fused(step.u, u_, dsp::fused(step.v, v_, step.x * x));
  }

  BandPassDesignOf<T> design_;
  T u_ = T(0.0f);  // the output
  T v_ = T(0.0f);  // its scaled integral
  T peak_ = T(0.0f);
};

}  // namespace channel
