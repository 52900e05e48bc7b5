#pragma once
// How well constants explain a recording: deviations of each step's features, in standard
// deviations. Numbers beyond the constants are the levels of the plan, in dB beside what it says.
#include <cstddef>
#include <utility>
#include <vector>

#include "sim/fit/rule_parameters.hpp"
#include "sim/fit/step_features.hpp"

namespace sim {

enum class FeatureKind : std::size_t { reported, low, start, first_run, count };
inline constexpr std::size_t n_feature_kinds = static_cast<std::size_t>(FeatureKind::count);

/// The places of all steps of a plan.
std::vector<std::size_t> all_steps_of(const Plan& plan);

class PlanLikelihood {
 public:
  /// The steps that are looked at; the others are not played either.
  PlanLikelihood(const Plan& plan, const std::vector<BurstOutput>& recorded,
                 const std::vector<std::size_t>& steps, const ParameterPriors& priors,
                 double level_error_db);

  std::size_t parameters() const { return priors_.size(); }
  std::size_t levels() const { return level_db_.size(); }
  const std::vector<ParameterPrior>& priors() const { return priors_; }
  Numbers start() const;

  /// Deviations of all features, a row of kinds a step; 0 where there is nothing to compare.
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

  const Plan& plan() const { return plan_; }
  const std::vector<std::size_t>& level_of_step() const { return level_of_step_; }
  double deviation_of(std::size_t step, FeatureKind kind) const {
    return sigma_[step * n_feature_kinds + static_cast<std::size_t>(kind)];
  }

 private:
  std::vector<double> amplitudes(const Numbers& x) const;
  /// Of how many steps on this one's carrier the feature is alike.
  double alike(std::size_t step, FeatureKind kind) const;
  void play(const Numbers& x, double more_hold_cycles, double more_db) const;
  std::vector<double> values(const Numbers& x, double more_hold_cycles, double more_db,
                             std::vector<Compared>* compared) const;

  Plan plan_;
  std::vector<BurstOutput> recorded_;
  std::vector<std::size_t> first_;
  std::vector<double> level_db_;            // distinct ones
  std::vector<std::size_t> level_of_step_;  // its place in them
  std::vector<StepFeatures> heard_;         // of the recording alone
  std::vector<ParameterPrior> priors_;
  std::vector<double> sigma_;
  mutable std::vector<BurstOutput> ruled_;
  mutable std::vector<double> played_;  // numbers for which `ruled_` was
};

}  // namespace sim
