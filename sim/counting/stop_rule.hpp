#pragma once
// When a point has been run long enough. A rule looks at the counts of the first runs only, at
// fixed numbers of runs, so it stops at the same run on any machine.
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "sim/counting/statistics.hpp"
#include "sim/counting/tally.hpp"

namespace sim {

/// The numbers are those of the result file.
enum class StopReason : std::int16_t {
  max_frames = 0,
  max_frame_errors = 1,
  interrupted = 2,
  rel_ci = 3,
  target_flr = 4
};

/// All reasons' names in the order of their numbers: "max_frames", ...
std::span<const char* const> stop_reason_names();
const char* stop_reason_name(StopReason reason);

struct StopRule {
  std::uint64_t max_frames = 1000;
  std::uint64_t max_frame_errors = 0;  // of worth_of_losses(); 0: no such limit
  /// Half the width of the bit error ratio's 95 % interval over the ratio; 0: no such rule.
  double rel_ci = 0;
  /// A frame loss ratio from which the point's is surely told, below or above it: by its 99.9 %
  /// interval. 0: no such rule.
  double target_flr = 0;
};

/// Lost frames; weighted ones are worth as many as would say as much of both ratios.
double worth_of_losses(const Tally& counted);

/// The levels of the intervals that rel_ci and target_flr look at.
constexpr double usual_level = 0.95;
constexpr double sure_level = 0.999;

/// On which side of a level a point's frame loss surely is.
enum class Side { unknown, below, above };
Side side_of(const Tally& counted, double flr);

/// Whether a rule looks at a ratio or figure.
bool looks_at_ratio(const StopRule& rule);

/// What a rule looks at.
struct StopFigures {
  /// At a level of confidence: the ratio or figure of rel_ci, and the loss of target_flr.
  std::function<Estimate(double level)> ratio, loss;
  double losses = 0;  // of max_frame_errors
};

/// Those of a link's trials: BER, FLR and worth_of_losses(). The tally must outlive them.
StopFigures figures_of(const Tally& counted);

/// Which rule has enough with these; nothing where none has. max_frames is not looked at.
std::optional<StopReason> stop_reason(const StopRule& rule, const StopFigures& counted);

/// Behind how many runs a rule looks next: behind every eighth; behind 256 less often, as it then
/// costs more and another eight say less.
std::uint32_t next_look(std::uint32_t done);
bool is_look(std::uint32_t done);

}  // namespace sim
