#include "sim/link_experiment/link_json.hpp"

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <variant>
#include <vector>

#include "sim/link/validity.hpp"
#include "sim/result/alarms.hpp"
#include "sim/result/axis_json.hpp"
#include "sim/result/ranking.hpp"
#include "sim/result/unit_spread_json.hpp"
#include "sim/scenario/flags.hpp"
#include "sim/text/json_answer.hpp"

namespace sim {
namespace {

using Json = nlohmann::ordered_json;

using Kind = Crossing::Kind;

/// A cell of a variable; what is not known is null.
Json json_cell(const Dataset::Variable& variable, std::size_t i) {
  if (const auto* reals = std::get_if<std::vector<double>>(&variable.values)) return reals->at(i);
  const std::int64_t number = std::get<std::vector<std::int64_t>>(variable.values).at(i);
  if (!variable.is_choice) return number;
  if (number == no_choice) return nullptr;
  return variable.flags.at(static_cast<std::size_t>(number));
}

const char* crossing_name(Crossing::Kind kind) {
  static constexpr std::array names{"fitted",    "jump",    "bracketed",    "all_below",
                                    "all_above", "unclear", "not_monotone", "unfinished"};
  return names.at(static_cast<std::size_t>(kind));
}

Json json_crossing(const LinkResult& result, const Ranking& ranking, const RowCrossing& row) {
  Json json;
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
  json["at"] = c.kind == Kind::fitted ? Json(c.at) : nullptr;
  json["low"] = at_one_place ? json_end(c.low) : nullptr;
  json["high"] = at_one_place ? json_end(c.high) : nullptr;
  const bool has_bound =
      c.kind == Kind::jump || c.kind == Kind::all_below || c.kind == Kind::all_above;
  json["not_ruled_out"] = has_bound ? Json(c.bound) : nullptr;
  if (row.doubt) json["doubt"] = json_doubt(*row.doubt);
  return json;
}

/// In the order of the ranking.
Json json_crossings(const LinkResult& result, const Ranking& ranking) {
  Json json = Json::array();
  for (const RowCrossing& row : ranking.rows) json.push_back(json_crossing(result, ranking, row));
  return json;
}

template <class Flag>
Json raised_json(std::span<const Flag> table, std::uint64_t mask) {
  Json names = Json::array();
  for (const Flag* flag : raised(table, mask)) names.push_back(flag->name);
  return names;
}

/// Point i, with the variables of the result file.
Json json_point(const LinkResult& result, const Dataset& data, std::size_t i) {
  const LinkPoint& p = result.points[i];
  Json point;
  for (std::size_t axis = 0; axis < result.axes.size(); ++axis)
    point[result.axes[axis].key] = json_coordinate(result.axes[axis], p.coordinates[axis]);
  point["outside"] = raised_json(validity_limits(), p.validity_flags);
  point["alarm_names"] = raised_json(alarms(), p.alarms);
  for (const Dataset::Variable& variable : data.variables)
    point[variable.facts.name] = json_cell(variable, i);
  return point;
}

}  // namespace

std::string to_json(const LinkResult& result, const Dataset& data, const Ranking& ranking) {
  Json json{{"title", result.title},       {"command", result.command},
            {"seed", result.seed},         {"ci_level", LinkResult::ci_level},
            {"eb_convention", "average"},  {"shards", shards_text(result.shards)},
            {"result_digest", data.digest}};
  json["axes"] = Json::array();
  for (const Axis& a : result.axes) json["axes"].push_back(json_axis(a));
  json["points"] = Json::array();
  for (std::size_t i = 0; i < result.points.size(); ++i)
    json["points"].push_back(json_point(result, data, i));
  json["crossings"] = json_crossings(result, ranking);
  if (const auto units = unit_spread(data)) json["units"] = json_units(*units);
  return json_page(json);
}

}  // namespace sim
