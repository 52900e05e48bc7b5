#include "sim/page/number_effects.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <span>
#include <utility>

#include "sim/components/drawn_part.hpp"
#include "sim/counting/sample_quantile.hpp"
#include "sim/loading/point_scenario.hpp"

namespace sim {
namespace {

constexpr std::size_t least_units = 6;

/// A range that is known as a bracket only; what is beyond the sweep stands at its end.
double middle_of(const Axis& axis, const UnitRange& range) {
  if (std::isinf(range.low)) return std::ranges::min(axis.values);
  if (std::isinf(range.high)) return std::ranges::max(axis.values);
  return range.low > 0 ? std::sqrt(range.low * range.high) : (range.low + range.high) / 2;
}

/// Equal values share the mean of their ranks.
std::vector<double> ranks_of(const std::vector<double>& values) {
  std::vector<double> ranks;
  for (const double value : values) {
    const auto below = std::ranges::count_if(values, [&](double v) { return v < value; });
    const auto equal = std::ranges::count(values, value);
    ranks.push_back(static_cast<double>(below) + static_cast<double>(equal - 1) / 2);
  }
  return ranks;
}

/// Spearman's; 0 where one of the two does not vary.
double rank_correlation(const std::vector<double>& x, const std::vector<double>& y) {
  const std::vector<double> a = ranks_of(x), b = ranks_of(y);
  const double mean = static_cast<double>(a.size() - 1) / 2;
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - mean) * (b[i] - mean);
    aa += (a[i] - mean) * (a[i] - mean);
    bb += (b[i] - mean) * (b[i] - mean);
  }
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

/// Places of values, the lowest first.
std::vector<std::size_t> in_order(const std::vector<double>& values) {
  std::vector<std::size_t> places(values.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  std::ranges::stable_sort(places, {}, [&](std::size_t i) { return values[i]; });
  return places;
}

std::vector<double> chosen(const std::vector<double>& values, std::span<const std::size_t> places) {
  std::vector<double> some;
  for (const std::size_t place : places) some.push_back(values[place]);
  return some;
}

NumberEffect effect_of(const DrawnNumber& number, const std::vector<double>& values,
                       const std::vector<double>& ranges) {
  const std::vector<std::size_t> order = in_order(values);
  const std::size_t third = order.size() / 3;
  const std::span<const std::size_t> all(order), low = all.first(third), high = all.last(third);
  return {.key = number.key,
          .unit = number.unit,
          .range_at_low = sample_quantile(chosen(ranges, low), 0.5),
          .range_at_high = sample_quantile(chosen(ranges, high), 0.5),
          .low = sample_quantile(chosen(values, low), 0.5),
          .high = sample_quantile(chosen(values, high), 0.5),
          .correlation = rank_correlation(values, ranges)};
}

/// The drawn numbers of each unit of a row.
std::vector<std::vector<DrawnNumber>> numbers_of_units(const LoadedScenario& scenario,
                                                       const UnitSpread& spread) {
  const RangeSpread& row = spread.rows.front();
  std::vector<std::vector<DrawnNumber>> all;
  for (const double unit : row.units) {
    std::vector<double> coordinates;
    std::size_t other = 0;
    for (const Axis& axis : scenario.sweep) {
      if (axis.key == unit_key)
        coordinates.push_back(unit);
      else if (axis.key == spread.axes[*spread.abscissa].key)
        coordinates.push_back(axis.values.front());
      else
        coordinates.push_back(row.others[other++]);
    }
    all.push_back(drawn_numbers(point_scenario(scenario, coordinates)));
  }
  return all;
}

}  // namespace

std::vector<double> middles_of(const Axis& axis, const RangeSpread& row) {
  std::vector<double> middles;
  for (const UnitRange& range : row.ranges) middles.push_back(middle_of(axis, range));
  return middles;
}

std::vector<NumberEffect> number_effects(const LoadedScenario& scenario, const UnitSpread& spread) {
  if (spread.rows.empty() || spread.rows.front().units.size() < least_units) return {};
  const RangeSpread& row = spread.rows.front();
  const std::vector<double> ranges = middles_of(spread.axes[*spread.abscissa], row);
  const auto units = numbers_of_units(scenario, spread);
  const double told = 1.96 / std::sqrt(static_cast<double>(row.units.size() - 1));
  std::vector<NumberEffect> effects;
  for (std::size_t i = 0; i < units.front().size(); ++i) {
    std::vector<double> values;
    for (const auto& numbers : units) values.push_back(numbers[i].value);
    NumberEffect effect = effect_of(units.front()[i], values, ranges);
    if (std::abs(effect.correlation) > told) effects.push_back(std::move(effect));
  }
  std::ranges::stable_sort(effects, std::ranges::greater(),
                           [](const NumberEffect& e) { return std::abs(e.correlation); });
  return effects;
}

}  // namespace sim
