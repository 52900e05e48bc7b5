#pragma once
#include <limits>

namespace sim {

/// One operating point on every axis that people use.
struct OperatingPoint {
  double irradiance_mw_per_m2 = 0;  // effective, peak of the on/off waveform
  double ambient_w_per_m2 = 0;
  double snr_db = 0;            // behind the band-pass, in its noise bandwidth
  double snr_bandwidth_hz = 0;  // that bandwidth
  double ebn0_db = 0;           // average-energy convention
  double ber_theory = std::numeric_limits<double>::quiet_NaN();   // of a matched receiver
  double ber_sampled = std::numeric_limits<double>::quiet_NaN();  // of its waveform's samples
};

}  // namespace sim
