#pragma once
// Captures of one module as a fit sees them: what each plan showed and what each recording has of
// it, one behind the other in one time.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/fit/pin_recording.hpp"
#include "sim/fit/plan_alignment.hpp"
#include "sim/fit/plan_text.hpp"
#include "sim/fit/rule_parameters.hpp"
#include "sim/fit/step_features.hpp"

namespace sim {

/// What a module was shown, and what its output made of it.
struct LightCapture {
  Plan plan;
  PinRecording recording;
  /// Irradiance of the plan's first step at the module. Of the first capture: if it is not known,
  /// Emin is that of the module like it. Of others: it is then found in the recording.
  std::optional<double> first_level_mw_per_m2;
  double ambient_w_per_m2 = 0;  // of a lamp on the module; the first capture has none
};

/// A capture among all.
struct JoinedCapture {
  double begin_ms = 0;  // of its plan
  PlanAlignment alignment;
  std::size_t levels_of = 0;  // the first one with the same plan: its levels are wrong by as much
  ParameterPrior level;       // dB over the first capture's light, as the comparator sees it
  std::size_t steps = 0;      // of its plan that are taken, from the first one on
  bool is_cut_short = false;  // the recording ends before what would be taken
};

/// Where a step is from.
struct JoinedStep {
  std::size_t capture = 0;
  std::size_t step = 0;  // in its own plan
};

struct JoinedLight {
  Plan plan;  // levels are relative to the first step of the capture they are of
  std::vector<BurstOutput> recorded;
  std::vector<JoinedStep> steps;
  std::vector<JoinedCapture> captures;
};

/// Between two captures is dark in which any gain comes back. Of one that repeats the plan of
/// another, or is under a lamp, only the steps up to the first train behind a long carrier are
/// taken: trains tell nothing more in other light. Throws Failure(bad_input) where a
/// recording and its plan have nothing in common, or all are too many bursts.
JoinedLight join(const std::vector<LightCapture>& captures, double level_error_db);

/// The same with the first bursts alone of each step that has more.
JoinedLight cut_trains(const JoinedLight& light, std::uint64_t most);

/// By how much the levels of long carriers may be further apart than the plans say, as a share: the
/// standard deviation of a straight line's slope through them. 0 where they have one level alone.
double scale_error(const JoinedLight& light, double level_error_db);

}  // namespace sim
