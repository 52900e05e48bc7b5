// `cosys-sim diff`: do two results say the same?
#include <fmt/format.h>

#include "sim/columns/estimate_text.hpp"
#include "sim/command/commands.hpp"
#include "sim/counting/statistics.hpp"
#include "sim/failure.hpp"
#include "sim/result/comparison.hpp"
#include "sim/result/dataset_comparison.hpp"
#include "sim/result/netcdf_reader.hpp"
#include "sim/result/stored_dataset.hpp"
#include "sim/result/stored_result.hpp"
#include "sim/text/escaped_text.hpp"
#include "sim/text/input_file.hpp"
#include "sim/text/rounded_text.hpp"
#include "sim/text/standard_output.hpp"

namespace sim {
namespace {

std::string coordinates_of(const LinkResult& result, std::size_t point) {
  std::string text;
  for (std::size_t i = 0; i < result.axes.size(); ++i)
    text += fmt::format("{} = {}, ", result.axes[i].key,
                        coordinate_text(result.axes[i], result.points[point].coordinates[i]));
  return text;
}

std::string ratio_of(const LinkResult& result, const RatioTest& test) {
  const Tally& tally = result.points[test.point].tally;
  const bool loss = test.ratio == ComparedRatio::flr;
  const Estimate e = (loss ? frame_loss_ratio : bit_error_ratio)(tally, LinkResult::ci_level);
  return fmt::format("{} of {} {} ({} [{}, {}])", loss ? tally.n_frames_lost : tally.n_bit_errors,
                     loss ? tally.n_frames : tally.n_bits, loss ? "lost" : "bits wrong",
                     significant_text(e.value, 3), significant_text(e.low, 3, Rounding::down),
                     significant_text(e.high, 3, Rounding::up));
}

std::string verdict(const ResultComparison& c, double alpha) {
  if (c.equal) return "equal: the same counts at every point\n";
  if (c.compared == 0) return "unknown: no point has an estimate in both\n";
  const std::size_t different = c.different();
  if (different == 0)
    return fmt::format(
        "compatible: no point of {} differs in frame loss or BER by more than chance\n",
        c.compared);
  return fmt::format(
      "different: {} of {} points in frame loss or BER (all together at most {:g} of equals would "
      "be called so)\n",
      different, c.compared, alpha);
}

std::string unknown_note(const ResultComparison& c) {
  if (c.equal || c.unknown == 0) return "";
  return fmt::format("not compared: {} whose weights give no estimate (alarm weights)\n",
                     c.unknown == 1 ? "a point" : fmt::format("{} points", c.unknown));
}

/// Equal counts may be of scenarios that have nothing in common.
std::string scenario_note(const Origin& one, const Origin& other) {
  return one.scenario_toml == other.scenario_toml
             ? ""
             : "they are of other scenarios, options or seeds\n";
}

void refuse_other_axes(const DiffRequest& request, const std::vector<Axis>& a,
                       const std::vector<Axis>& b) {
  if (!same_axes(a, b))
    throw bad_input(request.one.string() + " and " + request.other.string(),
                    "they are of different sweeps", "give results of the same points");
}

/// 0 where they agree.
ExitCode code_of(bool agree) { return agree ? ExitCode::done : ExitCode::check_failed; }

ExitCode diff_links(const DiffRequest& request) {
  const StoredResult one = read_result(request.one), other = read_result(request.other);
  const LinkResult &a = one.result, &b = other.result;
  refuse_other_axes(request, a.axes, b.axes);
  const ResultComparison c = compare(a, b, request.alpha);
  std::string text = verdict(c, request.alpha);
  for (const RatioTest& test : c.tests)
    if (test.different)
      text += fmt::format("{}p = {:.2g}: {} against {}\n", coordinates_of(a, test.point),
                          test.p_value, ratio_of(a, test), ratio_of(b, test));
  print(text + unknown_note(c) + scenario_note(one.origin, other.origin));
  return code_of(c.equal || (c.compared > 0 && c.different() == 0));
}

// ---- other experiments ----

std::string verdict(const DatasetComparison& c, double alpha) {
  if (c.equal) return "equal: the same counts at every point\n";
  if (c.tests.empty()) return "unknown: no ratio has an interval in both\n";
  if (c.different() == 0)
    return fmt::format("compatible: no ratio of {} differs by more than chance\n", c.tests.size());
  return fmt::format(
      "different: {} of {} ratios (all together at most {:g} of equals would be called so)\n",
      c.different(), c.tests.size(), alpha);
}

std::string test_text(const CellTest& test) {
  const std::string place = test.place.empty() ? "" : test.place + ", ";
  return fmt::format("{}p = {:.2g}: {} {} against {}\n", escaped_name(place), test.p_value,
                     escaped_name(test.name), estimate_text(test.one), estimate_text(test.other));
}

ExitCode diff_experiments(const DiffRequest& request) {
  const StoredDataset one = read_dataset(request.one), other = read_dataset(request.other);
  if (one.data.experiment != other.data.experiment)
    throw bad_input(request.one.string() + " and " + request.other.string(),
                    fmt::format("one is of an experiment \"{}\", the other of \"{}\"",
                                one.data.experiment, other.data.experiment),
                    "give results of one experiment");
  refuse_other_axes(request, one.data.axes, other.data.axes);
  const DatasetComparison c = compare(one.data, other.data, request.alpha);
  std::string text = verdict(c, request.alpha);
  for (const CellTest& test : c.tests)
    if (test.different) text += test_text(test);
  if (!c.equal && c.unknown > 0)
    text += fmt::format("not compared: {} that only one of the two has\n",
                        c.unknown == 1 ? "a ratio" : fmt::format("{} ratios", c.unknown));
  print(text + scenario_note(one.origin, other.origin));
  return code_of(c.equal || (!c.tests.empty() && c.different() == 0));
}

bool is_experiment(const std::filesystem::path& path) {
  refuse_no_file(path, "result");
  return filetype_of(path) == experiment_result_type;
}

}  // namespace

ExitCode diff_command(const DiffRequest& request) {
  const bool one = is_experiment(request.one), other = is_experiment(request.other);
  return one && other ? diff_experiments(request) : diff_links(request);
}

}  // namespace sim
