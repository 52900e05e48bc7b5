#pragma once
// The one resonator of a receiver module: |H| = 1 / sqrt(1 + Q^2 (f/f0 - f0/f)^2), which is
// Vishay 82459 rev 1.8 Fig. 5 within 0.004 at Q = 10. Discretised exactly for an input that is
// constant over each sample (matrix exponential), so the response does not warp with the rate.
#include "dsp/lanes.hpp"
#include "dsp/units.hpp"

namespace channel {

/// What the output is a part of a sample later: of itself, of its integral and of the input.
struct BandPassStep {
  float u, v, x;
};

struct BandPassDesign {
  BandPassStep output, integral;   // over a whole sample
  BandPassStep third, two_thirds;  // the output on the way
};

/// Needs q > 0.5 and a sample rate above 2 f0. Makes up for the droop at f0 of an input that is
/// held for a sample, and for `input_gain`, what a stage before this one leaves of a signal at f0.
BandPassDesign design_band_pass(dsp::Hertz centre, double q, dsp::Hertz sample_rate,
                                double input_gain = 1);

template <class T>
class BandPass {
 public:
  explicit BandPass(const BandPassDesign& design) : design_(design) {}

  /// One sample in; the output at its end.
  T operator()(T x) {
    const T u = after(design_.output, x);
    peak_ = dsp::larger(u, dsp::larger(after(design_.third, x), after(design_.two_thirds, x)));
    v_ = after(design_.integral, x);
    return u_ = u;
  }

  /// Largest output in the last sample. A comparator watches all the time: of a wave that it sees
  /// at sample instants alone it misses up to (pi f / rate)^2 / 2 of each peak.
  T peak() const { return peak_; }

 private:
  T after(const BandPassStep& step, T x) const {
    return dsp::fused(T(step.u), u_, dsp::fused(T(step.v), v_, T(step.x) * x));
  }

  BandPassDesign design_;
  T u_ = T(0.0f);  // the output
  T v_ = T(0.0f);  // its scaled integral
  T peak_ = T(0.0f);
};

}  // namespace channel
