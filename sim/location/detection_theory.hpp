#pragma once
// Closed forms of detection in white Gaussian noise for the detectors of channel/carrier_detector,
// against which trials are checked. Statistics are in units of the noise without light; noise may
// be larger with light, for light has shot noise. Probabilities of false alarm are in (0, 1).
// Kay, Fundamentals of Statistical Signal Processing II: Detection Theory (1998): chapter 4
// (Gaussian shift), theorem 7.1 (chi-square, two degrees of freedom).
#include "sim/scenario/detector.hpp"

namespace sim {

/// What a statistic is with light.
struct DetectionLaw {
  double signal = 0;    // the statistic without noise: a shift; of goertzel the noncentrality
  double widening = 1;  // deviation of the statistic's noise over that without light
};

/// The threshold that noise alone exceeds with probability `pfa`: a normal quantile; -2 ln(pfa).
double detection_threshold(Detector detector, double pfa);

/// Probability that the statistic exceeds that threshold with light: Q((t - d) / w), d the shift
/// and w the widening; of goertzel Marcum's Q1(sqrt(lambda) / w, sqrt(t) / w).
double detection_probability(Detector detector, double pfa, const DetectionLaw& law);

}  // namespace sim
