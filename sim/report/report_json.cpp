#include "sim/report/report_json.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <variant>

#include "sim/link/validity.hpp"
#include "sim/result/alarms.hpp"
#include "sim/result/ranking.hpp"
#include "sim/scenario/flags.hpp"

namespace sim {
namespace {

using Json = nlohmann::ordered_json;

using Kind = Crossing::Kind;

nlohmann::ordered_json json_value(const LinkColumn& column, const PointResult& p, double ci_level) {
  struct Read {
    const PointResult& p;
    double level;
    Json operator()(std::uint64_t Tally::*count) const { return p.tally.*count; }
    Json operator()(std::uint64_t PointResult::*count) const { return p.*count; }
    Json operator()(LinkColumn::Sum sum) const {
      Weighted weighted = p.tally.weighted;
      return sum(weighted);
    }
    Json operator()(LinkColumn::Real real) const { return real(p, level); }
    Json operator()(StopReason PointResult::*flag) const {
      return measured(p) ? Json(stop_reason_name(p.*flag)) : Json(nullptr);
    }
  };
  return std::visit(Read{p, ci_level}, column.value);
}

nlohmann::ordered_json json_coordinate(const Axis& axis, double coordinate) {
  if (axis.is_text()) return axis.labels.at(static_cast<std::size_t>(coordinate));
  return coordinate;
}

const char* crossing_name(Crossing::Kind kind) {
  static constexpr std::array names{"fitted",    "jump",    "bracketed",    "all_below",
                                    "all_above", "unclear", "not_monotone", "unfinished"};
  return names.at(static_cast<std::size_t>(kind));
}

/// JSON has no infinity.
nlohmann::ordered_json end_of(double end) {
  return std::isfinite(end) ? nlohmann::ordered_json(end) : nullptr;
}

nlohmann::ordered_json json_crossing(const ExperimentResult& result, const Ranking& ranking,
                                     const RowCrossing& row) {
  nlohmann::ordered_json json;
  for (std::size_t i = 0; i < ranking.others.size(); ++i) {
    const Axis& other = result.axes[ranking.others[i]];
    json[other.key] = json_coordinate(other, row.others[i]);
  }
  const Crossing& c = row.crossing;
  const bool at_one_place =
      c.kind == Kind::fitted || c.kind == Kind::jump || c.kind == Kind::bracketed;
  json["along"] = result.axes[ranking.abscissa].key;
  json["flr"] = ranking.flr;
  json["kind"] = crossing_name(c.kind);
  json["at"] = c.kind == Kind::fitted ? nlohmann::ordered_json(c.at) : nullptr;
  json["low"] = at_one_place ? end_of(c.low) : nullptr;
  json["high"] = at_one_place ? end_of(c.high) : nullptr;
  const bool has_bound =
      c.kind == Kind::jump || c.kind == Kind::all_below || c.kind == Kind::all_above;
  json["not_ruled_out"] = has_bound ? nlohmann::ordered_json(c.bound) : nullptr;
  return json;
}

/// In the order of the ranking.
nlohmann::ordered_json json_crossings(const ExperimentResult& result,
                                      const CrossingQuestion& question) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  const Ranking ranking = rank(result, question);
  for (const RowCrossing& row : ranking.rows) json.push_back(json_crossing(result, ranking, row));
  return json;
}

nlohmann::ordered_json json_axis(const Axis& a) {
  nlohmann::ordered_json json{{"key", a.key}, {"unit", a.unit}, {"long_name", a.long_name}};
  if (a.is_text())
    json["values"] = a.labels;
  else
    json["values"] = a.values;
  return json;
}

template <class Flag>
nlohmann::ordered_json raised_json(std::span<const Flag> table, std::uint64_t mask) {
  nlohmann::ordered_json names = nlohmann::ordered_json::array();
  for (const Flag* flag : raised(table, mask)) names.push_back(flag->name);
  return names;
}

nlohmann::ordered_json json_point(const ExperimentResult& result, const PointResult& p) {
  nlohmann::ordered_json point;
  for (std::size_t i = 0; i < result.axes.size(); ++i) {
    point[result.axes[i].key] = json_coordinate(result.axes[i], p.coordinates[i]);
  }
  point["outside"] = raised_json(validity_limits(), p.validity_flags);
  point["alarm_names"] = raised_json(alarms(), p.alarms);
  for (const LinkColumn* column : columns_of(result))
    point[column->name] = json_value(*column, p, result.ci_level);
  return point;
}

}  // namespace

std::string to_json(const ExperimentResult& result, const CrossingQuestion& question) {
  nlohmann::ordered_json json{{"title", result.title},
                              {"command", result.command},
                              {"seed", result.seed},
                              {"ci_level", result.ci_level},
                              {"eb_convention", "average"},
                              {"shards", shards_text(result.shards)},
                              {"result_digest", result_digest(result)}};
  json["axes"] = nlohmann::ordered_json::array();
  for (const Axis& a : result.axes) json["axes"].push_back(json_axis(a));
  json["points"] = nlohmann::ordered_json::array();
  for (const PointResult& p : result.points) json["points"].push_back(json_point(result, p));
  json["crossings"] = json_crossings(result, question);
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace sim
