#pragma once
// What a report of results of links says, in the order in which people ask: how far does it reach,
// what was simulated, the curves, what became of lost frames, all numbers.
#include <optional>
#include <string>
#include <vector>

#include "sim/page/omissions.hpp"
#include "sim/page/page.hpp"
#include "sim/page/shown_trial.hpp"
#include "sim/result/result.hpp"

namespace sim {

struct ReportedResult {
  std::string name;  // of its file
  ExperimentResult result;
  Omissions omissions;
  std::optional<ShownTrial> trial = {};
};

/// At least one result.
Page report_of(const std::vector<ReportedResult>& results);

}  // namespace sim
