#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "sim/fit/fit_report.hpp"
#include "sim/fit/fit_words.hpp"
#include "sim/fit/measured_part.hpp"
#include "sim/section/picture_sections.hpp"
#include "sim/text/unit_text.hpp"

namespace sim {
namespace {

constexpr double sigmas_of_95 = 1.96;

/// Steps of one quantity, and what they are drawn over: their levels where these differ, else their
/// places in the plans, one behind the other.
struct QuantitySteps {
  std::vector<FittedStep> steps;
  bool by_level = false;

  double x(const std::vector<MeasuredCapture>& captures, const FittedStep& step) const {
    if (by_level) return step.level_db;
    std::size_t place = step.step;
    for (std::size_t k = 0; k < step.capture; ++k) place += captures[k].steps;
    return static_cast<double>(place);
  }
};

std::vector<std::string> quantities_of(const FittedModule& fit) {
  std::vector<std::string> names;
  for (const FittedStep& step : fit.steps)
    if (std::ranges::find(names, step.quantity) == names.end()) names.push_back(step.quantity);
  return names;
}

QuantitySteps steps_of(const MeasuredModule& measured, const std::string& quantity) {
  QuantitySteps all;
  std::set<double> levels;
  for (const FittedStep& step : measured.fit.steps) {
    if (step.quantity != quantity) continue;
    all.steps.push_back(step);
    levels.insert(step.level_db);
  }
  all.by_level = levels.size() > 1;
  std::ranges::stable_sort(all.steps, {},
                           [&](const FittedStep& step) { return all.x(measured.captures, step); });
  return all;
}

ChartAxis lower_axis(const QuantitySteps& all) {
  if (all.by_level)
    return {.label = "level [dB]", .words = "irradiance over that of the first step"};
  return {.label = "step", .words = "place in the plan", .is_count = true};
}

/// What was recorded, with the interval that its deviation from the rule is measured in.
ChartPoint recorded_point(double x, const FittedStep& step) {
  const double sigma =
      step.deviation == 0 ? 0 : std::abs((step.recorded - step.fitted) / step.deviation);
  return {x, step.recorded, step.recorded - sigmas_of_95 * sigma,
          step.recorded + sigmas_of_95 * sigma};
}

Chart fit_chart(const MeasuredModule& measured, const std::string& quantity) {
  const QuantitySteps all = steps_of(measured, quantity);
  ChartCurve recorded{.name = "recorded", .points = {}};
  ChartCurve fitted{.name = "fitted", .points = {}, .kind = CurveKind::theory};
  for (const FittedStep& step : all.steps) {
    const double x = all.x(measured.captures, step);
    recorded.points.push_back(recorded_point(x, step));
    fitted.points.push_back({x, step.fitted, step.fitted, step.fitted});
  }
  const std::string unit = bracketed_unit(all.steps.front().unit);
  return {.title = "Recorded and fitted: " + quantity,
          .description = quantity + ", as recorded and as the fitted module has it",
          .x = lower_axis(all),
          .y = {.label = quantity + (unit.empty() ? "" : " " + unit)},
          .curves = {std::move(recorded), std::move(fitted)}};
}

/// Beside 0, where all are but for chance if the part follows the rule.
Chart residual_chart(const MeasuredModule& measured, const std::string& quantity) {
  const QuantitySteps all = steps_of(measured, quantity);
  ChartCurve residuals{.name = "recorded less fitted", .points = {}};
  ChartCurve none{.name = "none", .points = {}, .kind = CurveKind::theory};
  for (const FittedStep& step : all.steps) {
    const double x = all.x(measured.captures, step);
    residuals.points.push_back(
        {x, step.deviation, step.deviation - sigmas_of_95, step.deviation + sigmas_of_95});
    none.points.push_back({x, 0, 0, 0});
  }
  return {.title = "Residuals: " + quantity,
          .description = "recorded less fitted, in standard deviations: " + quantity,
          .x = lower_axis(all),
          .y = {.label = "residual [standard deviations]"},
          .curves = {std::move(residuals), std::move(none)}};
}

PageSection constants_section(const MeasuredModule& measured) {
  return {
      .heading = "Constants",
      .text = "What is not told has in the part's file what fits best, with bounds that are wide.",
      .table = PageTable{
          .head = constants_head(measured), .rows = constants_rows(measured), .is_answer = true}};
}

PageSection misfits_section(const FittedModule& fit) {
  PageTable table{.head = {"what", "by how much"}, .rows = {}, .is_answer = true};
  for (const FitMisfit& misfit : fit.misfits)
    table.rows.push_back({misfit.what, misfit.by_how_much});
  return {.heading = "Where the part does not follow the rule", .table = std::move(table)};
}

}  // namespace

Page measured_page(const MeasuredModule& measured) {
  Page page{.title = fmt::format("{}: a module like {}", files_in_words(measured.captures),
                                 measured.like.name),
            .summary = {},
            .sections = {constants_section(measured)}};
  for (const std::string& sentence : fit_sentences(measured)) page.summary += sentence + "\n";
  if (!measured.fit.misfits.empty()) page.sections.push_back(misfits_section(measured.fit));
  for (const std::string& quantity : quantities_of(measured.fit)) {
    page.sections.push_back(chart_section(fit_chart(measured, quantity)));
    page.sections.push_back(chart_section(residual_chart(measured, quantity)));
  }
  return page;
}

}  // namespace sim
