#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "sim/fit/fit_report.hpp"
#include "sim/fit/fit_words.hpp"
#include "sim/fit/measured_part.hpp"
#include "sim/section/picture_sections.hpp"
#include "sim/text/letters.hpp"
#include "sim/text/unit_text.hpp"

namespace sim {
namespace {

constexpr double sigmas_of_95 = 1.96;

/// Steps of one quantity, and what they are drawn over: their levels, where hardly any two are
/// alike, else what the fitted module makes of them.
struct QuantitySteps {
  std::vector<FittedStep> steps;
  bool by_level = false;

  double x(const FittedStep& step) const { return by_level ? step.level_db : step.fitted; }
};

/// In the plans, one behind the other.
double place_of(const std::vector<MeasuredCapture>& captures, const FittedStep& step) {
  std::size_t place = step.step;
  for (std::size_t k = 0; k < step.capture; ++k) place += captures[k].steps;
  return static_cast<double>(place);
}

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
  constexpr std::size_t most_at_a_level = 4;
  all.by_level = levels.size() > 1 && most_at_a_level * levels.size() >= all.steps.size();
  std::ranges::stable_sort(all.steps, {}, [&](const FittedStep& step) { return all.x(step); });
  return all;
}

/// What was recorded, with the interval that its deviation from the rule is measured in. Shares are
/// within what there is.
ChartPoint recorded_point(double x, const FittedStep& step) {
  const double sigma =
      step.deviation == 0 ? 0 : std::abs((step.recorded - step.fitted) / step.deviation);
  const double low = step.recorded - sigmas_of_95 * sigma;
  const double high = step.recorded + sigmas_of_95 * sigma;
  if (step.unit != "%") return {x, step.recorded, low, high};
  return {x, step.recorded, std::max(low, 0.0), std::min(high, 100.0)};
}

/// Behind the kind of light, which the heading has: "length of the output [cycle]".
std::string upright_label(const FittedStep& step) {
  const std::size_t at = step.quantity.find(": ");
  const std::string unit = bracketed_unit(step.unit);
  return step.quantity.substr(at == std::string::npos ? 0 : at + 2) +
         (unit.empty() ? "" : " " + unit);
}

ChartAxis lower_axis(const QuantitySteps& all) {
  if (all.by_level) return {.label = "light over the first step's [dB]"};
  return {.label = "fitted " + upright_label(all.steps.front())};
}

/// Steps of one carrier: a module is deafer to others than its own.
void add_curves(const QuantitySteps& all, double carrier_hz, const std::string& of,
                std::vector<ChartCurve>& curves) {
  ChartCurve recorded{.name = "recorded" + of, .points = {}};
  ChartCurve fitted{.name = "fitted" + of, .points = {}, .kind = CurveKind::theory};
  for (const FittedStep& step : all.steps) {
    if (step.carrier_hz != carrier_hz) continue;
    const double x = all.x(step);
    recorded.points.push_back(recorded_point(x, step));
    fitted.points.push_back({x, step.fitted, step.fitted, step.fitted});
  }
  curves.push_back(std::move(recorded));
  curves.push_back(std::move(fitted));
}

Chart fit_chart(const MeasuredModule& measured, const std::string& quantity) {
  const QuantitySteps all = steps_of(measured, quantity);
  std::set<double> carriers;
  for (const FittedStep& step : all.steps) carriers.insert(step.carrier_hz);
  Chart chart{.title = capitalised(quantity),
              .description = quantity + ", as recorded and as the fitted module has it",
              .x = lower_axis(all),
              .y = {.label = upright_label(all.steps.front())},
              .curves = {}};
  for (const double carrier_hz : carriers)
    add_curves(all, carrier_hz,
               carriers.size() == 1 ? "" : fmt::format(", {:.1f} kHz", carrier_hz / 1e3),
               chart.curves);
  return chart;
}

/// Of all steps in the order of the plan. Nearly all are within 2, if the part follows the rule.
Chart residual_chart(const MeasuredModule& measured) {
  ChartCurve residuals{.name = "recorded less fitted", .points = {}};
  for (const FittedStep& step : measured.fit.steps)
    residuals.points.push_back(
        {place_of(measured.captures, step), step.deviation, step.deviation, step.deviation});
  return {.title = "Residuals",
          .description =
              "recorded less fitted, in standard deviations, of all that the recording "
              "has of each step",
          .x = {.label = "step", .words = "place in the plan", .is_count = true},
          .y = {.label = "residual [standard deviations]"},
          .curves = {std::move(residuals)}};
}

PageSection constants_section(const MeasuredModule& measured) {
  return {
      .heading = "Constants",
      .text = "What is not told has in the part's file what fits best, with bounds that are wide.",
      .table = PageTable{
          .head = constants_head(measured), .rows = constants_rows(measured), .is_answer = true}};
}

std::string paragraphs_of(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += sentence + "\n";
  return text;
}

PageSection misfits_section(const FittedModule& fit) {
  PageTable table{.head = {"what", "by how much"}, .rows = {}, .is_answer = true};
  for (const FitMisfit& misfit : fit.misfits)
    table.rows.push_back({misfit.what, misfit.by_how_much});
  return {.heading = "Where the part does not follow the rule", .table = std::move(table)};
}

}  // namespace

Page measured_page(const MeasuredModule& measured) {
  const FittedModule& fit = measured.fit;
  Page page{.title = fmt::format("{}: a module like {}", files_in_words(measured.captures),
                                 measured.like.name),
            .summary = paragraphs_of(answer_sentences(measured)),
            .sections = {constants_section(measured)}};
  if (!fit.misfits.empty()) page.sections.push_back(misfits_section(fit));
  page.sections.push_back({.heading = "What the recording says, and what not",
                           .text = paragraphs_of(further_sentences(measured))});
  for (const std::string& quantity : quantities_of(fit))
    page.sections.push_back(chart_section(fit_chart(measured, quantity)));
  if (!fit.steps.empty()) page.sections.push_back(chart_section(residual_chart(measured)));
  return page;
}

}  // namespace sim
