#include <nlohmann/json.hpp>

#include "sim/check/check_report.hpp"
#include "sim/text/json_answer.hpp"
#include "sim/text/row_table.hpp"

namespace sim {
namespace {

using Json = nlohmann::ordered_json;

Json counts_json(const FrameCounts& counts) {
  return {{"n_frames", counts.frames},
          {"n_frames_lost", counts.lost},
          {"n_frames_undetected", counts.undetected_error}};
}

const char* name(Pairing pairing) {
  switch (pairing) {
    case Pairing::stored:
      return "stored";
    case Pairing::decoded:
      return "decoded again";
    case Pairing::unpaired:
      return "unpaired";
  }
  return "";
}

const char* name(DecoderFault::Kind kind) {
  using enum DecoderFault::Kind;
  switch (kind) {
    case timeout:
      return "timeout";
    case killed:
      return "killed";
    case exit_code:
      return "exit code";
    case garbage:
      return "garbage";
  }
  return "";
}

Json fault_json(const std::optional<DecoderFault>& fault) {
  if (!fault) return nullptr;
  return {{"kind", name(fault->kind)}, {"what", fault->what}, {"stderr", fault->words}};
}

/// JSON has no NaN.
Json number_or_null(double value) { return value == value ? Json(value) : Json(nullptr); }

Json point_json(const PointCheck& c) {
  return {{"name", c.point.name},
          {"scenario", c.point.file.string()},
          {"point", c.point.number},
          {"verdict", name(c.verdict)},
          {"pairing", name(c.pairing)},
          {"baseline", counts_json(c.baseline)},
          {"candidate", counts_json(c.candidate)},
          {"p_lost", std::min(1.0, c.p_lost)},
          {"p_undetected", std::min(1.0, c.p_undetected)},
          {"power", number_or_null(c.power)},
          {"frames_needed", c.frames_needed == 0 ? Json(nullptr) : Json(c.frames_needed)},
          {"lost_by_candidate_alone", c.only_candidate_lost},
          {"lost_by_baseline_alone", c.only_baseline_lost},
          {"undetected_by_candidate_alone", c.only_candidate_undetected},
          {"fault", fault_json(c.fault)}};
}

Json point_row(const PointCheck& c) {
  return {{"name", c.point.name},
          {"scenario", c.point.file.string()},
          {"point", c.point.number},
          {"verdict", name(c.verdict)},
          {"pairing", name(c.pairing)},
          {"baseline_n_frames", c.baseline.frames},
          {"baseline_n_frames_lost", c.baseline.lost},
          {"baseline_n_frames_undetected", c.baseline.undetected_error},
          {"candidate_n_frames", c.candidate.frames},
          {"candidate_n_frames_lost", c.candidate.lost},
          {"candidate_n_frames_undetected", c.candidate.undetected_error},
          {"p_lost", std::min(1.0, c.p_lost)},
          {"p_undetected", std::min(1.0, c.p_undetected)},
          {"power", number_or_null(c.power)},
          {"fault", c.fault ? Json(name(c.fault->kind)) : Json(nullptr)}};
}

}  // namespace

std::string check_table(const std::filesystem::path& place, const CheckReport& report) {
  std::vector<Json> rows;
  for (const PointCheck& check : report.checks) rows.push_back(point_row(check));
  return row_table(place, rows);
}

bool is_check_table(const std::filesystem::path& path) {
  return begins_as_csv(path, "name,scenario,point,verdict,") || begins_as_json_lines(path, "name");
}

std::string check_json(const CheckReport& report) {
  Json points = Json::array();
  for (const PointCheck& check : report.checks) points.push_back(point_json(check));
  const SequentialTestRule& rule = report.setup.rule;
  const Json json{{"verdict", name(verdict_of(report.checks))},
                  {"candidate", report.setup.candidate.name()},
                  {"baseline", report.baseline.decoder},
                  {"baseline_file", report.baseline_file.string()},
                  {"golden", report.setup.golden},
                  {"worse_than", rule.worse_than},
                  {"alpha", rule.alpha},
                  {"asked_power", rule.power},
                  {"negligible", rule.negligible},
                  {"points", std::move(points)}};
  return json_line(json);
}

}  // namespace sim
