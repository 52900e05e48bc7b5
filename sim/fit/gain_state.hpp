#pragma once
// The slow AGC of the rule of channel/slow_agc.hpp in continuous time, from one spell of activity
// to the next.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/fit/rule_constants.hpp"

namespace sim {

inline constexpr double decibels_a_decay = 20 / std::numbers::ln10;  // of an amplitude
/// 10^(db / 20).
inline double gain_of(double db) { return std::exp(db * (1 / decibels_a_decay)); }
inline double decibels_of(double ratio) { return decibels_a_decay * std::log(ratio); }

/// As far as a number matters.
inline bool is_nearly(double one, double other) {
  constexpr double no_matter = 1e-9;
  return std::abs(one - other) <= no_matter * std::abs(one);
}

/// The slow AGC between two moments of activity.
class GainState {
 public:
  explicit GainState(const RuleConstants& c) : c_(&c) {}

  double db() const { return db_; }
  double burst_s() const { return burst_; }

  /// Without activity for so long, since the last one or the last call.
  void rest(double s) {
    const double before = std::max(quiet_ - c_->dark_hold_s, 0.0);
    quiet_ += s;
    const double recovered = std::max(quiet_ - c_->dark_hold_s, 0.0) - before;
    db_ = std::max(db_ - c_->release_db_per_s * recovered, 0.0);
  }

  /// How far it would be down after so long a rest.
  double db_after(double s) const {
    GainState later = *this;
    later.rest(s);
    return later.db_;
  }

  /// Rest from now until the gain has come back to `db`.
  double rest_to(double db) const {
    if (db_ <= db) return 0;
    return std::max(c_->dark_hold_s - quiet_, 0.0) + (db_ - db) / c_->release_db_per_s;
  }

  /// Time of activity from now until the gain has fallen to `db`; infinite where it never does.
  double time_to(double db) const {
    if (db <= db_) return 0;
    if (db > c_->range_db || c_->attack_db_per_s <= 0) return HUGE_VAL;
    const double burst = burst_now();
    if (burst > c_->long_burst_s) return (db - db_) / c_->attack_db_per_s;
    const double counted = (db - db_) / c_->attack_db_per_s + c_->free_s;
    return std::max(counted, c_->long_burst_s) - burst;
  }

  /// Activity for so long; the gain falls no further than to `most_db`.
  void active(double s, double most_db) {
    if (s <= 0) return;
    const double before = burst_now();
    const double burst = before + s;
    quiet_ = 0;
    burst_ = burst;
    if (burst <= c_->long_burst_s) return;
    const double charged =
        before > c_->long_burst_s ? s : burst - std::min(c_->free_s, c_->long_burst_s);
    const double most = std::min(std::max(most_db, db_), c_->range_db);
    db_ = std::min(db_ + c_->attack_db_per_s * charged, most);
  }

  /// Whether what follows is the same for both.
  bool goes_on_as(const GainState& other) const {
    if (!is_nearly(db_, other.db_)) return false;
    const double forgotten = std::max(c_->min_gap_s, db_ > 0 ? c_->dark_hold_s : 0);
    if (quiet_ > forgotten && other.quiet_ > forgotten) return true;
    return is_nearly(quiet_, other.quiet_) && is_nearly(burst_, other.burst_);
  }

 private:
  double burst_now() const { return quiet_ > c_->min_gap_s ? 0 : burst_; }

  const RuleConstants* c_;
  double db_ = 0;
  double burst_ = 0;  // activity since the last gap, s
  double quiet_ = 1e9;
};

}  // namespace sim
