#pragma once
// The numbers of a part's file out of the numbers of a search: each with where it lies, and whether
// the recording tells it.
#include <optional>
#include <string>
#include <vector>

#include "channel/receiver_module.hpp"
#include "sim/fit/fit_result.hpp"
#include "sim/fit/rule_search.hpp"

namespace sim {

/// What is known of a capture's light beside the first one's.
struct CaptureLight {
  std::optional<double> level_db;  // over the first one's; nothing: not known
  double ambient_w_per_m2 = 0;
};

/// What is known beside the recordings.
struct FittedLight {
  const channel::ModuleData& like;
  std::optional<double> first_level_mw_per_m2;
  double level_error = 0;  // a share
  std::vector<CaptureLight> captures;
};

/// In the order of a part's file.
std::vector<FittedNumber> fitted_numbers(const RuleFit& fit, const ParameterPriors& priors,
                                         const FittedLight& light);

/// Whether it is told how far light is above what the comparator needs.
bool is_threshold_told(const RuleFit& fit, const ParameterPriors& priors);

/// Sentences on numbers of which only a sum or the like is told.
std::vector<std::string> pairs_not_apart(const RuleFit& fit, const ParameterPriors& priors);

}  // namespace sim
