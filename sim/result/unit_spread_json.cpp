#include "sim/result/unit_spread_json.hpp"

#include <nlohmann/json.hpp>

#include "sim/result/axis_json.hpp"

namespace sim {
namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson json_place(const std::vector<Axis>& axes, const std::vector<double>& coordinates) {
  OrderedJson json = OrderedJson::object();
  for (std::size_t i = 0; i < axes.size(); ++i)
    json[axes[i].key] = json_coordinate(axes[i], coordinates[i]);
  return json;
}

OrderedJson json_share(const UnitSpread& spread, const UnitShare& share) {
  OrderedJson json = json_place(spread.axes, share.coordinates);
  json["units"] = share.units;
  json["carried"] = share.carried;
  json["share"] =
      share.units == 0
          ? OrderedJson(nullptr)
          : OrderedJson(static_cast<double>(share.carried) / static_cast<double>(share.units));
  return json;
}

OrderedJson json_quantile(double quantile, const UnitRange& range) {
  return {{"quantile", quantile}, {"low", json_end(range.low)}, {"high", json_end(range.high)}};
}

OrderedJson json_ranges(const UnitSpread& spread, const RangeSpread& row) {
  OrderedJson json = json_place(axes_of_rows(spread), row.others);
  json["along"] = spread.axes[*spread.abscissa].key;
  json["units"] = row.units.size();
  json["quantiles"] = OrderedJson::array();
  for (std::size_t q = 0; q < spread_quantiles.size(); ++q)
    json["quantiles"].push_back(json_quantile(spread_quantiles[q], row.quantiles[q]));
  return json;
}

}  // namespace

nlohmann::ordered_json json_units(const UnitSpread& spread) {
  OrderedJson json{
      {"flr", spread.flr}, {"shares", OrderedJson::array()}, {"ranges", OrderedJson::array()}};
  for (const UnitShare& share : spread.shares) json["shares"].push_back(json_share(spread, share));
  for (const RangeSpread& row : spread.rows) json["ranges"].push_back(json_ranges(spread, row));
  return json;
}

nlohmann::ordered_json json_doubt(const RangeDoubt& doubt) {
  const UnitRange span = span_of(doubt.quantiles);
  return {{"part", doubt.part},
          {"units", doubt.units},
          {"low", json_end(span.low)},
          {"high", json_end(span.high)}};
}

}  // namespace sim
