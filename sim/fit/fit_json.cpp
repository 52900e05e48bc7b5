#include <nlohmann/json.hpp>

#include "sim/fit/fit_report.hpp"
#include "sim/fit/measured_part.hpp"

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

Json steps_json(const MeasuredModule& measured) {
  Json all = Json::array();
  for (const FittedStep& step : measured.fit.steps)
    all.push_back({{"step", step.step},
                   {"level_db", measured.plan.steps[step.step].level_db},
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
  Json json{{"capture", measured.capture},  {"wire", measured.wire},
            {"plan", measured.plan_words},  {"like", measured.like.name},
            {"numbers", numbers_json(fit)}, {"not_apart", fit.not_apart},
            {"misfits", misfits_json(fit)}, {"clock_error", fit.clock_error},
            {"start_s", fit.start_s},       {"usual_deviation", fit.usual_deviation},
            {"steps", steps_json(measured)}};
  if (!measured.first_level_by.empty())
    json["first_level"] = {{"mw_per_m2", fit.first_level_mw_per_m2},
                           {"by", measured.first_level_by}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace sim
