#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "sim/check/false_accept_comparison.hpp"
#include "sim/columns/estimate_text.hpp"
#include "sim/columns/text_table.hpp"
#include "sim/text/json_answer.hpp"

namespace sim {
namespace {

using Json = nlohmann::ordered_json;
using FalseAcceptPoints = std::vector<FalseAcceptComparisonPoint>;

double hours_of(const FalseAcceptComparisonPoint& point, std::size_t decoder) {
  return static_cast<double>(point.accepts[decoder].n_runs) * point.hours_of_a_run;
}

/// A line a decoder, for there may be many.
std::vector<TextColumn> accepts_columns(const FalseAcceptPoints& points, const Decoders& decoders) {
  std::size_t names = 5, decoder_names = 7;
  for (const FalseAcceptComparisonPoint& point : points) names = std::max(names, point.name.size());
  for (const Decoder* decoder : decoders)
    decoder_names = std::max(decoder_names, decoder->name().size());
  return {{{"", "", "point"}, -static_cast<int>(names)},
          {{"", "", "decoder"}, -static_cast<int>(decoder_names)},
          {{"hours", "of line", "[h]"}, 8},
          {{"device's", "messages", "accepted"}, 8},
          {{"", "wrong", "accepts"}, 8},
          {{"wrong accepts", "[1/h]", "[interval]"}, -estimate_width}};
}

std::vector<std::string> accepts_row(const FalseAcceptComparisonPoint& point,
                                     const Decoders& decoders, std::size_t d) {
  const Accepts& accepts = point.accepts[d];
  if (accepts.fault) return {point.name, decoders[d]->name(), "", "", "", "failed"};
  return {point.name,
          decoders[d]->name(),
          fmt::format("{:.4g}", hours_of(point, d)),
          fmt::format("{}", accepts.n_ok),
          fmt::format("{}", accepts.n_wrong),
          estimate_text(point.wrong_per_hour(d))};
}

std::string faults_while_listening(const FalseAcceptPoints& points, const Decoders& decoders) {
  std::string text;
  for (const FalseAcceptComparisonPoint& point : points)
    for (std::size_t d = 0; d < decoders.size(); ++d)
      if (const auto& fault = point.accepts[d].fault)
        text += fault_line(decoders[d]->name(), point.name, *fault);
  return text;
}

Json decoder_json(const FalseAcceptComparisonPoint& point, const Decoders& decoders,
                  std::size_t d) {
  const Accepts& accepts = point.accepts[d];
  const Estimate rate = point.wrong_per_hour(d);
  return {{"decoder", decoders[d]->name()},
          {"n_runs", accepts.n_runs},
          {"line_h", hours_of(point, d)},
          {"n_accepted_ok", accepts.n_ok},
          {"n_accepted_wrong", accepts.n_wrong},
          {"wrong_per_hour", rate.value},
          {"wrong_per_hour_ci_low", rate.low},
          {"wrong_per_hour_ci_high", rate.high},
          {"fault", accepts.fault ? Json(accepts.fault->what) : Json(nullptr)}};
}

}  // namespace

std::string false_accept_comparison_text(const FalseAcceptPoints& points,
                                         const Decoders& decoders) {
  const std::vector<TextColumn> columns = accepts_columns(points, decoders);
  std::string text = table_head(columns);
  for (const FalseAcceptComparisonPoint& point : points)
    for (std::size_t d = 0; d < decoders.size(); ++d)
      text += table_line(columns, accepts_row(point, decoders, d));
  return text + faults_while_listening(points, decoders);
}

std::string false_accept_comparison_json(const FalseAcceptPoints& points,
                                         const Decoders& decoders) {
  Json list = Json::array();
  for (const FalseAcceptComparisonPoint& point : points) {
    Json of_point = Json::array();
    for (std::size_t d = 0; d < decoders.size(); ++d)
      of_point.push_back(decoder_json(point, decoders, d));
    list.push_back({{"name", point.name}, {"decoders", std::move(of_point)}});
  }
  const Json json{{"ci_level", 0.95}, {"points", std::move(list)}};
  return json_line(json);
}

}  // namespace sim
