#pragma once
// What a result of a link brings to a report, in the order in which people ask: how far does it
// reach, what was simulated, the curves, what became of lost frames, all numbers.
#include <optional>
#include <string>
#include <vector>

#include "sim/page/ablations.hpp"
#include "sim/page/frame_statistics.hpp"
#include "sim/page/number_effects.hpp"
#include "sim/page/shown_trial.hpp"
#include "sim/result/ranking.hpp"
#include "sim/result/result.hpp"
#include "sim/section/report_section.hpp"

namespace sim {

struct LinkReport {
  std::string name;  // of its file
  LinkResult result;
  Ranking ranking;  // how far it reaches, with its doubts
  Ablations ablations;
  std::vector<NumberEffect> effects = {};  // where units were swept
  FrameStatistics frames{};                // where the link fails, or else of the first point
  std::optional<ShownTrial> trial = {};
  std::string why_no_trial = {};       // a line, or empty
  std::vector<Setting> settings = {};  // of its scenario
};

ReportSection link_section(const LinkReport& link);

}  // namespace sim
