// `cosys-sim diff`: do two results say the same?
#include <fmt/format.h>

#include "sim/commands.hpp"
#include "sim/comparison.hpp"
#include "sim/failure.hpp"
#include "sim/standard_output.hpp"
#include "sim/statistics.hpp"
#include "sim/stored_result.hpp"

namespace sim {
namespace {

std::string coordinates_of(const ExperimentResult& result, std::size_t point) {
  std::string text;
  for (std::size_t i = 0; i < result.axes.size(); ++i)
    text += fmt::format("{} = {}, ", result.axes[i].key,
                        coordinate_text(result.axes[i], result.points[point].coordinates[i]));
  return text;
}

std::string loss_of(const ExperimentResult& result, std::size_t point) {
  const Tally& tally = result.points[point].tally;
  const Estimate e = frame_loss_ratio(tally, result.ci_level);
  return fmt::format("{} of {} lost ({:.3g} [{:.3g}, {:.3g}])", tally.n_frames_lost, tally.n_frames,
                     e.value, e.low, e.high);
}

std::string verdict(const ResultComparison& c, double alpha) {
  if (c.equal) return "equal: the same counts at every point\n";
  if (c.points.empty()) return "unknown: no point has an estimate of its loss in both\n";
  const std::size_t different = c.different();
  if (different == 0)
    return fmt::format("compatible: no point of {} differs in frame loss by more than chance\n",
                       c.points.size());
  return fmt::format(
      "different: {} of {} points in frame loss (all together at most {:g} of "
      "equals would be called so)\n",
      different, c.points.size(), alpha);
}

std::string unknown_note(const ResultComparison& c) {
  if (c.equal || c.unknown == 0) return "";
  return fmt::format("not compared: {} points whose weights give no estimate (alarm weights)\n",
                     c.unknown);
}

}  // namespace

ExitCode diff_command(const DiffRequest& request) {
  const ExperimentResult a = read_result(request.one).result;
  const ExperimentResult b = read_result(request.other).result;
  if (!same_axes(a, b))
    throw bad_input(request.one.string() + " and " + request.other.string(),
                    "they are of different sweeps", "give results of the same points");
  const ResultComparison comparison = compare(a, b, request.alpha);
  std::string text = verdict(comparison, request.alpha);
  for (const PointComparison& p : comparison.points)
    if (p.different)
      text += fmt::format("{}p = {:.2g}: {} against {}\n", coordinates_of(a, p.point), p.p_value,
                          loss_of(a, p.point), loss_of(b, p.point));
  print(text + unknown_note(comparison));
  const bool agree =
      comparison.equal || (!comparison.points.empty() && comparison.different() == 0);
  return agree ? ExitCode::done : ExitCode::check_failed;
}

}  // namespace sim
