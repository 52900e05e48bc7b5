#pragma once
// A receiver module as numbers for one step a carrier cycle (channel/envelope.hpp).
#include "channel/slow_agc.hpp"
#include "dsp/lanes.hpp"

namespace channel {

/// Deviations of a step's noise in phase and in quadrature, which are correlated: (re, im) =
/// (re x, cross x + im y) of two standard normals.
template <class T>
struct EnvelopeNoise {
  T re, cross, im;
};

/// Steps between two looks of the slow AGC at its activity.
constexpr int steps_per_tick = 4;

/// A module in the light of one operating point; amplitudes in mW/m2, times in steps.
template <class T>
struct EnvelopeDesignOf {
  T keep_re, keep_im;          // what a step leaves of a response without input
  T drift_re, drift_im;        // its derivative, of itself
  T seen;                      // share of a step's noise that its peak sees
  EnvelopeNoise<T> dark, lit;  // of a step
  EnvelopeNoise<T> resting;    // of the response to noise after long dark
  T peak;                      // of the band-pass output in steady light
  T threshold;                 // of the fixed comparator, slow AGC at rest
  T atc_fraction, atc_decay;   // of a step
  T atc_octaves;               // the same decay in powers of two
  T hold, integrator;
  SlowAgcDesignOf<T> agc;
  T least_db;  // of the gain, above which noise is not seen as activity
};
using EnvelopeDesign = EnvelopeDesignOf<float>;

}  // namespace channel
