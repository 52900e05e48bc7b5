#pragma once
// How well constants explain a recording: deviations of each step's features, in standard
// deviations. Numbers beyond the constants of the rule are, of each capture behind the first one,
// where it begins, its clock, and its light; and then the levels of the plans, in dB beside what
// these say.
#include <array>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "sim/fit/joined_light.hpp"
#include "sim/fit/rule_parameters.hpp"
#include "sim/fit/step_features.hpp"

namespace sim {

enum class FeatureKind : std::size_t { reported, low, start, first_run, count };
inline constexpr std::size_t n_feature_kinds = static_cast<std::size_t>(FeatureKind::count);

/// The places of all steps of a plan.
std::vector<std::size_t> all_steps_of(const Plan& plan);

class PlanLikelihood {
 public:
  /// The steps that are looked at; the others are not played either. Numbers are the same
  /// whichever they are.
  PlanLikelihood(const JoinedLight& light, const std::vector<std::size_t>& steps,
                 const ParameterPriors& priors, double level_error_db);

  std::size_t parameters() const { return priors_.size(); }
  /// Numbers before those of the levels.
  std::size_t before_levels() const { return first_level_; }
  const std::vector<ParameterPrior>& priors() const { return priors_; }
  Numbers start() const;

  /// Gives the deviations of all features, a row of kinds a step, to `take`, until it says no; 0
  /// where there is nothing to compare.
  void visit_deviations(const Numbers& x, const std::function<bool(double)>& take) const;
  Numbers deviations(const Numbers& x) const;
  /// The same, and what was compared.
  struct Compared {
    StepFeatures recorded, ruled;
  };
  std::vector<Compared> compared(const Numbers& x) const;

  /// Deviations for constants that may be far off: wide, and the same wherever they are.
  void take_wide_deviations();
  /// Takes for each feature what small errors of levels and times make of it here.
  void take_deviations_at(const Numbers& x);

  /// Bursts that were played so far: the work that was done.
  std::uint64_t bursts_played() const { return rule_.bursts_played(); }

  const Plan& plan() const { return plan_; }
  const JoinedStep& origin(std::size_t step) const { return origin_[step]; }
  /// Over the first step of the first capture, as the plans and the light of captures have it.
  double level_db(const Numbers& x, std::size_t step) const;
  double deviation_of(std::size_t step, FeatureKind kind) const {
    return sigma_[step * n_feature_kinds + static_cast<std::size_t>(kind)];
  }

 private:
  /// A level that may be wrong: of one plan.
  struct PlanLevel {
    std::size_t levels_of;
    double db;
  };
  /// Among all numbers; where there is none yet, the next place.
  std::size_t place_of_level(const PlanLevel& level) const;
  void add_level(const PlanLevel& level, double level_error_db);
  std::vector<double> amplitudes(const Numbers& x) const;
  /// Of how many steps on this one's carrier the feature is alike.
  double alike(std::size_t step, FeatureKind kind) const;
  double uncertain_cut(const Numbers& x, std::size_t step, const Compared& compared) const;
  /// Numbers, and how else they may be.
  struct Played {
    const Numbers& x;
    double more_hold_cycles = 0, more_db = 0;
  };
  /// Looks at each step when it was played, until `look` says no.
  void play(const Played& played, const std::function<bool(std::size_t)>& look) const;
  Compared compared_bursts(std::size_t step) const;
  /// With where the capture begins, and its clock.
  Compared compared_step(const Numbers& x, std::size_t step) const;
  /// What a step's features differ by.
  std::array<double, n_feature_kinds> differences(const Compared& compared, std::size_t step) const;
  std::vector<double> differences(const Played& played) const;

  Plan plan_;
  std::vector<BurstOutput> recorded_;
  std::vector<std::size_t> first_;
  std::vector<JoinedStep> origin_;
  std::vector<JoinedCapture> captures_;
  std::vector<PlanLevel> levels_;           // distinct ones of all steps of the light
  std::vector<std::size_t> level_of_step_;  // its place among all numbers
  std::size_t first_level_;                 // their first number
  std::vector<StepFeatures> heard_;         // of the recording alone
  std::vector<ParameterPrior> priors_;
  std::vector<double> sigma_;
  mutable OutputOfRule rule_;
  mutable std::vector<Compared> compared_;  // of the steps that were shown
};

}  // namespace sim
