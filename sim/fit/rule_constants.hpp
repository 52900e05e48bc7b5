#pragma once
// The constants of the rule of channel/slow_agc.hpp and channel/demodulator.hpp in the units of a
// fit: seconds, and amplitudes relative to the light of the plan's first step, as a part in tune
// sees it.

namespace sim {

struct RuleConstants {
  double centre_hz = 56e3, q = 10;
  double threshold = 1e-2;  // of the comparator, slow AGC at rest
  double hold_s = 0;        // of the comparator
  double integrator_s = 0;
  double atc_fraction = 0.4, atc_release_s = 10e-3;
  double attack_db_per_s = 300, release_db_per_s = 130;
  double long_burst_s = 0, free_s = 0, min_gap_s = 0, dark_hold_s = 0;
  double margin_db = 3, range_db = 120;

  bool operator==(const RuleConstants&) const = default;
};

}  // namespace sim
