#include <nlohmann/json.hpp>

#include "sim/fit/fit_report.hpp"
#include "sim/fit/measured_part.hpp"
#include "sim/text/json_answer.hpp"

namespace sim {
namespace {

using Json = nlohmann::ordered_json;

Json numbers_json(const FittedModule& fit) {
  Json all = Json::array();
  for (const FittedNumber& number : fit.numbers) {
    Json row{{"name", number.key},
             {"value", number.value},
             {"low", number.low},
             {"high", number.high},
             {"unit", unit_of_number(number.key)},
             {"is_told", number.is_told}};
    if (!number.more.empty()) row["would_tell"] = number.more;
    all.push_back(std::move(row));
  }
  return all;
}

Json captures_json(const MeasuredModule& measured) {
  Json all = Json::array();
  for (std::size_t k = 0; k < measured.captures.size(); ++k) {
    const MeasuredCapture& capture = measured.captures[k];
    const FittedCapture& fitted = measured.fit.captures[k];
    Json row{{"file", capture.file},
             {"wire", capture.wire},
             {"plan", capture.plan_words},
             {"ambient_w_per_m2", capture.ambient_w_per_m2},
             {"start_s", fitted.start_s},
             {"clock_error", fitted.clock_error},
             {"level_db", fitted.level_db},
             {"n_steps", capture.steps},
             {"n_fitted_steps", fitted.fitted_steps},
             {"n_lost_pairs", capture.lost_pairs}};
    all.push_back(std::move(row));
  }
  return all;
}

Json steps_json(const FittedModule& fit) {
  Json all = Json::array();
  for (const FittedStep& step : fit.steps)
    all.push_back({{"capture", step.capture},
                   {"step", step.step},
                   {"level_db", step.level_db},
                   {"quantity", step.quantity},
                   {"unit", step.unit},
                   {"recorded", step.recorded},
                   {"fitted", step.fitted},
                   {"deviation", step.deviation}});
  return all;
}

Json misfits_json(const FittedModule& fit) {
  Json all = Json::array();
  for (const FitMisfit& misfit : fit.misfits)
    all.push_back({{"what", misfit.what}, {"by_how_much", misfit.by_how_much}});
  return all;
}

}  // namespace

std::string measured_json(const MeasuredModule& measured) {
  const FittedModule& fit = measured.fit;
  Json json{{"captures", captures_json(measured)},
            {"like", measured.like.name},
            {"numbers", numbers_json(fit)},
            {"not_apart", fit.not_apart},
            {"misfits", misfits_json(fit)},
            {"strongest_over_emin_db",
             fit.strongest_over_emin_db ? Json(*fit.strongest_over_emin_db) : Json(nullptr)},
            {"usual_deviation", fit.usual_deviation},
            {"steps", steps_json(fit)}};
  if (fit.output_width)
    json["output_width_cycles"] = {{"least", fit.output_width->least_cycles},
                                   {"most", fit.output_width->most_cycles}};
  if (!measured.first_level_by.empty())
    json["first_level"] = {{"mw_per_m2", measured.first_level_mw_per_m2},
                           {"by", measured.first_level_by}};
  return json_line(json);
}

}  // namespace sim
