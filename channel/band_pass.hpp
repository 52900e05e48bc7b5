#pragma once
// The one resonator of a receiver module: |H| = 1 / sqrt(1 + Q^2 (f/f0 - f0/f)^2), which is
// Vishay 82459 rev 1.8 Fig. 5 within 0.004 at Q = 10. Discretised exactly for an input that is
// constant over each sample (matrix exponential), so the response does not warp with the rate.
#include "dsp/lanes.hpp"
#include "dsp/units.hpp"

namespace channel {

struct BandPassDesign {
  float uu, uv, vu, vv;  // state transition over one sample
  float ux, vx;          // input to state; makes up for the hold's droop at f0
};

/// Needs q > 0.5 and a sample rate above 2 f0.
BandPassDesign design_band_pass(dsp::Hertz centre, double q, dsp::Hertz sample_rate);

template <class T>
class BandPass {
 public:
  explicit BandPass(const BandPassDesign& d)
      : uu_(d.uu), uv_(d.uv), vu_(d.vu), vv_(d.vv), ux_(d.ux), vx_(d.vx) {}

  T operator()(T x) {
    const T u = dsp::fused(uu_, u_, dsp::fused(uv_, v_, ux_ * x));
    v_ = dsp::fused(vu_, u_, dsp::fused(vv_, v_, vx_ * x));
    return u_ = u;
  }

 private:
  T uu_, uv_, vu_, vv_, ux_, vx_;
  T u_ = T(0.0f);  // the output
  T v_ = T(0.0f);  // its scaled integral
};

}  // namespace channel
