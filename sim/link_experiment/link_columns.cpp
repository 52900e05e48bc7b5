#include "sim/link_experiment/link_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "sim/columns/columns_dataset.hpp"
#include "sim/columns/stop_column.hpp"
#include "sim/columns/validity_column.hpp"
#include "sim/counting/statistics.hpp"
#include "sim/counting/tally_counters.hpp"
#include "sim/link_experiment/link_notes.hpp"
#include "sim/result/alarms.hpp"
#include "sim/result/point_loss.hpp"
#include "sim/scenario/experiment_kind.hpp"
#include "sim/scenario/flags.hpp"
#include "sim/text/rounded_text.hpp"

namespace sim {
namespace {

using Point = LinkPoint;

constexpr double ci_level = LinkResult::ci_level;

// Numbers as the table has them; "-" where they are not known, or there is no noise.

std::string irradiance_text(double value) {
  return std::isnan(value) ? "-" : fmt::format("{:.4g}", value);
}

std::string decibel_text(double value) {
  return std::isfinite(value) ? fmt::format("{:.1f}", value) : "-";
}

std::string theory_text(double ber) {
  if (std::isnan(ber)) return "-";
  return ber < 0.01 ? scientific_text(ber, 3) : fmt::format("{:.4f}", ber);
}

Column<Point>& add_counter(Columns<Point>& columns, const TallyCounter& counter) {
  return columns.count({counter.name, "1", counter.meaning},
                       [&counter](const Point& p) { return p.tally.*counter.count; });
}

/// How many frames a point has comes first.
void add_counters(Columns<Point>& columns) {
  const auto counters = tally_counters();
  const auto frames = std::ranges::find(counters, &Tally::n_frames, &TallyCounter::count);
  add_counter(columns, *frames);
  for (const TallyCounter& counter : counters)
    if (counter.count != &Tally::n_frames) add_counter(columns, counter);
}

Column<Point>& add_operating(Columns<Point>& columns, VariableFacts facts,
                             double OperatingPoint::*figure,
                             const RealText& text = significant(4)) {
  return columns.real(
      std::move(facts), [figure](const Point& p) { return p.operating.*figure; }, text);
}

void add_light(Columns<Point>& columns) {
  using O = OperatingPoint;
  add_operating(
      columns, {"irradiance_mw_per_m2", "mW m-2", "effective irradiance at the module, carrier on"},
      &O::irradiance_mw_per_m2, irradiance_text)
      .headed({{"", "irradiance", "[mW/m2]"}, number_width})
      .spared_before(2);
  add_operating(columns, {"ambient_w_per_m2", "W m-2", "ambient irradiance at the module"},
                &O::ambient_w_per_m2);
  add_operating(columns, {"snr_db", "dB", "signal-to-noise ratio behind the band-pass"}, &O::snr_db,
                decibel_text)
      .headed({{"", "SNR", "[dB]"}, 6})
      .spared_before(2);
  add_operating(columns, {"snr_bandwidth_hz", "Hz", "noise bandwidth of snr_db"},
                &O::snr_bandwidth_hz);
  add_operating(columns, {"ebn0_db", "dB", "energy per bit over noise density"}, &O::ebn0_db);
}

void add_bit_errors(Columns<Point>& columns) {
  columns.count({}, [](const Point& p) { return p.tally.n_frames; })
      .known_before()
      .headed({{"", "", "frames"}, number_width});
  columns.count({}, [](const Point& p) { return p.tally.n_bit_errors; })
      .known_before()
      .headed({{"", "bit", "errors"}, number_width})
      .spared_before(3);
  columns
      .ratio({"ber", "1", "bit error ratio"},
             [](const Point& p) { return bit_error_ratio(p.tally, ci_level); })
      .headed({{"", "bit error ratio", "[interval]"}, -estimate_width});
  add_operating(columns, {"ber_theory", "1", "bit error ratio of a matched receiver in theory"},
                &OperatingPoint::ber_theory, theory_text)
      .headed({{"", "in theory", ""}, number_width})
      .called("BER in theory")
      .shown_if(has_theory);
  add_operating(columns, {"ber_sampled", "1", "the same of the samples of its waveform"},
                &OperatingPoint::ber_sampled);
}

/// Lost over frames, with an interval that allows for a stop by target_flr.
Estimate stored_loss(const Point& p) {
  Estimate loss = frame_loss_of(p, ci_level);
  loss.value = frame_loss_ratio(p.tally, ci_level).value;
  return loss;
}

void add_losses(Columns<Point>& columns) {
  columns.ratio({"flr", "1", "frame loss ratio"}, stored_loss)
      .drawn({"Frame loss", "frame loss ratio (FLR)", true});
  columns.count({}, [](const Point& p) { return p.tally.n_frames_lost; }).called("frames lost");
  columns.ratio({}, [](const Point& p) { return frame_loss_of(p, ci_level); })
      .headed({{"", "frame loss ratio", "[interval]"}, -estimate_width});
  columns.ratio({"uer", "1", "undetected frame error ratio"},
                [](const Point& p) { return undetected_error_ratio(p.tally, ci_level); });
  columns.count({}, [](const Point& p) { return p.tally.n_frames_undetected; })
      .called("undetected errors");
}

std::string real_time_text(double factor) {
  if (!std::isfinite(factor)) return "-";
  if (factor >= 1e6) return scientific_text(factor, 2) + "x";
  return fmt::format("{:.{}f}x", factor, factor < 10 ? 1 : 0);
}

void add_costs(Columns<Point>& columns) {
  columns.real({"elapsed_s", "s", "wall-clock time"}, [](const Point& p) { return p.elapsed_s; })
      .known_before();
  columns
      .real({"simulated_s", "s", "simulated time of the link"},
            [](const Point& p) { return p.simulated_s; })
      .known_before();
  columns.count({"n_samples", "1", "waveform samples simulated"},
                [](const Point& p) { return p.n_samples; });
  columns
      .real(
          {}, [](const Point& p) { return p.simulated_s / p.elapsed_s; }, real_time_text)
      .headed({{"", "real", "time"}, 7})
      .spared_before(4);
}

void add_marks(Columns<Point>& columns) {
  add_validity_flags(columns).headed({{}, 0});
  columns.flags(
      {"alarms", "1", "why the counts are to be distrusted"},
      [](const Point& p) { return p.alarms; }, flag_names(alarms()));
  const auto reasons = stop_reason_names();
  add_stop_reason(columns, {reasons.begin(), reasons.end()});
  columns.words({}, closing_text).headed({{"", "", "stopped by"}, -16}).spared_before(1);
}

void add_spread(Columns<Point>& columns, const std::string& ratio, WeightedSum Weighted::*sum) {
  columns
      .real({ratio + "_cov", "1", "coefficient of variation of " + ratio},
            [sum](const Point& p) {
              const Weighted& weighted = p.tally.weighted;
              return (weighted.*sum).coefficient_of_variation(weighted.n_groups);
            })
      .kept_if(is_weighted);
  columns
      .real({ratio + "_ess", "1", "effective sample size of " + ratio},
            [sum](const Point& p) { return (p.tally.weighted.*sum).effective_size(); })
      .kept_if(is_weighted);
}

void add_weights(Columns<Point>& columns) {
  add_spread(columns, "ber", &Weighted::bit_errors);
  add_spread(columns, "flr", &Weighted::frames_lost);
  for (const WeightCounter& counter : weight_counters())
    columns
        .real({counter.name, "1", counter.meaning},
              [&counter](const Point& p) {
                Weighted weighted = p.tally.weighted;
                return counter.sum(weighted);
              })
        .known_before()
        .kept_if(is_weighted);
}

Columns<Point> made_columns() {
  Columns<Point> columns;
  add_counters(columns);
  add_light(columns);
  add_bit_errors(columns);
  add_losses(columns);
  add_costs(columns);
  add_marks(columns);
  add_weights(columns);
  return columns;
}

/// The bandwidth that all points have; nothing where they differ.
std::optional<double> common_bandwidth(const std::vector<Point>& points) {
  std::optional<double> common;
  for (const Point& p : points) {
    if (!p.reached()) continue;
    if (common && *common != p.operating.snr_bandwidth_hz) return std::nullopt;
    common = p.operating.snr_bandwidth_hz;
  }
  return common;
}

std::string interval_methods(bool weighted) {
  std::string counted =
      "flr, uer: Clopper-Pearson; ber: Clopper-Pearson on the effective number of bits, frames as "
      "clusters (Korn & Graubard 1998)";
  if (!weighted) return counted;
  return "where n_groups > 0, ber and flr: log-normal, by Student's t for so many groups; "
         "elsewhere " +
         counted;
}

}  // namespace

const Columns<LinkPoint>& link_columns() {
  static const Columns<Point> columns = made_columns();
  return columns;
}

bool has_theory(const LoadedScenario& scenario) {
  bool matched = channel::is_matched(scenario.base.module);
  for (const std::vector<Scenario>& variants : scenario.variants)
    for (const Scenario& variant : variants) matched |= channel::is_matched(variant.module);
  return matched;
}

void complete_link(Dataset& data, const std::vector<LinkPoint>& points) {
  data.digest = result_digest(data.axes, points);
  data.attributes = {{"ci_level", ci_level}, {"ci_method", interval_methods(is_weighted(points))}};
  for (Dataset::Variable& variable : data.variables) {
    if (variable.facts.name == "ebn0_db") variable.attributes = {{"eb_convention", "average"}};
    if (variable.facts.name != "snr_db") continue;
    variable.attributes = {{"ancillary_variables", "snr_bandwidth_hz"}};
    // The variable snr_bandwidth_hz has it where it is not one number.
    if (const auto bandwidth = common_bandwidth(points))
      variable.attributes.push_back({"bandwidth_hz", *bandwidth});
  }
}

Dataset link_dataset(const LinkResult& result) {
  Dataset data{.title = result.title,
               .scenario_toml = result.scenario_toml,
               .command = result.command,
               .experiment = std::string(link_kind.name),
               .seed = result.seed,
               .axes = result.axes,
               .shards = result.shards};
  ColumnsDataset<Point>(data, link_columns(), result.points).add_all();
  for (const Point& point : result.points) data.n_runs += point.tally.n_frames;
  complete_link(data, result.points);
  return data;
}

}  // namespace sim
