#include "sim/location/detection_theory.hpp"

#include <cmath>

#include "sim/link/theory.hpp"

namespace sim {

double detection_threshold(Detector detector, double pfa) {
  if (detector == Detector::goertzel) return -2 * std::log(pfa);
  return gaussian_q_inverse(pfa);
}

double detection_probability(Detector detector, double pfa, const DetectionLaw& law) {
  const double threshold = detection_threshold(detector, pfa);
  if (detector == Detector::goertzel)
    return marcum_q1(std::sqrt(law.signal) / law.widening, std::sqrt(threshold) / law.widening);
  return gaussian_q((threshold - law.signal) / law.widening);
}

}  // namespace sim
