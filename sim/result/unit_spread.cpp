#include "sim/result/unit_spread.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "sim/counting/statistics.hpp"
#include "sim/result/ranking.hpp"
#include "sim/scenario/sweep.hpp"

namespace sim {
namespace {

/// The number of the parts as their files have them, which no spread counts among its units.
constexpr double as_assumed = 0;

std::size_t unit_axis(const std::vector<Axis>& axes) {
  return static_cast<std::size_t>(std::ranges::find(axes, unit_key, &Axis::key) - axes.begin());
}

/// The losses of a unit along the range, by its values.
using Line = std::map<double, double>;

/// A result whose points are told apart by their unit.
class Grid {
 public:
  Grid(const std::vector<Axis>& axes, const std::vector<double>& losses)
      : axes_(axes), losses_(losses), unit_(unit_axis(axes)) {}

  std::size_t size() const { return losses_.size(); }
  double loss(std::size_t i) const { return losses_[i]; }
  std::vector<double> others(std::size_t i) const {
    return without_unit(axes_, point_coordinates(axes_, i));
  }
  double unit(std::size_t i) const { return point_coordinates(axes_, i)[unit_]; }
  bool is_drawn(std::size_t i) const { return unit(i) != as_assumed; }

 private:
  const std::vector<Axis>& axes_;
  const std::vector<double>& losses_;
  std::size_t unit_;
};

std::vector<UnitShare> shares_of(const std::vector<Axis>& axes, const std::vector<double>& losses,
                                 double flr) {
  std::vector<UnitShare> shares;
  for (const UnitGroup& group : unit_groups(axes)) {
    UnitShare& share = shares.emplace_back(UnitShare{group.coordinates, 0, 0});
    for (const std::size_t point : group.points) {
      if (std::isnan(losses[point])) continue;
      ++share.units;
      if (losses[point] <= flr) ++share.carried;
    }
  }
  return shares;
}

/// Whether more units carry at the greatest value than at the least; where they are as many, what
/// is known of the key.
bool is_better_from_above(const std::vector<UnitShare>& shares, const Axis& rising,
                          std::size_t abscissa) {
  std::ptrdiff_t gain = 0;
  for (const UnitShare& share : shares) {
    const auto carried = static_cast<std::ptrdiff_t>(share.carried);
    if (share.coordinates[abscissa] == rising.values.back()) gain += carried;
    if (share.coordinates[abscissa] == rising.values.front()) gain -= carried;
  }
  return gain == 0 ? known_direction(rising.key).value_or(false) : gain > 0;
}

/// From the good end on, up to the first at which more is lost than the level.
std::size_t n_carried(const Line& losses, double flr, bool from_above) {
  std::vector<double> from_good;
  for (const auto& [value, loss] : losses) from_good.push_back(loss);
  if (from_above) std::ranges::reverse(from_good);
  const auto end = std::ranges::find_if(from_good, [&](double loss) { return loss > flr; });
  return static_cast<std::size_t>(end - from_good.begin());
}

/// Lines of a unit each, in the order of the range, by the coordinates of the remaining axes.
using Lines = std::map<std::vector<double>, std::map<double, Line>>;

Lines lines_of(const Grid& grid, std::size_t abscissa) {
  Lines lines;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (!grid.is_drawn(i)) continue;
    std::vector<double> others = grid.others(i);
    const double value = others[abscissa];
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(abscissa));
    lines[others][grid.unit(i)][value] = grid.loss(i);
  }
  return lines;
}

std::vector<RangeSpread> range_rows(const Grid& grid, const UnitSpread& spread) {
  const Axis axis = in_rising_order(spread.axes[*spread.abscissa]);
  const bool from_above = is_better_from_above(spread.shares, axis, *spread.abscissa);
  std::vector<RangeSpread> rows;
  for (const auto& [others, units] : lines_of(grid, *spread.abscissa)) {
    RangeSpread row{others, {}, {}, {}};
    for (const auto& [unit, line] : units) {
      if (std::ranges::any_of(line, [](const auto& at) { return std::isnan(at.second); })) continue;
      row.units.push_back(unit);
      row.ranges.push_back(
          range_carried(axis, n_carried(line, spread.flr, from_above), from_above));
    }
    if (row.units.empty()) continue;
    row.quantiles = range_quantiles(row.ranges, from_above);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

bool has_units(const std::vector<Axis>& axes) {
  const std::size_t at = unit_axis(axes);
  if (at == axes.size()) return false;
  const std::vector<double>& units = axes[at].values;
  return units.size() - static_cast<std::size_t>(std::ranges::count(units, as_assumed)) > 1;
}

std::vector<Axis> without_unit(std::vector<Axis> axes) {
  axes.erase(axes.begin() + static_cast<std::ptrdiff_t>(unit_axis(axes)));
  return axes;
}

std::vector<double> without_unit(const std::vector<Axis>& axes, std::vector<double> coordinates) {
  coordinates.erase(coordinates.begin() + static_cast<std::ptrdiff_t>(unit_axis(axes)));
  return coordinates;
}

std::vector<UnitGroup> unit_groups(const std::vector<Axis>& axes) {
  std::vector<UnitGroup> groups;
  std::map<std::vector<double>, std::size_t> known;
  const std::size_t unit = unit_axis(axes);
  for (std::size_t i = 0; i < count_points(axes); ++i) {
    const std::vector<double> coordinates = point_coordinates(axes, i);
    const std::vector<double> others = without_unit(axes, coordinates);
    const auto [at, is_new] = known.try_emplace(others, groups.size());
    if (is_new) groups.push_back({others, {}});
    if (coordinates[unit] != as_assumed) groups[at->second].points.push_back(i);
  }
  return groups;
}

std::optional<UnitSpread> unit_spread(const std::vector<Axis>& axes,
                                      const std::vector<double>& losses, double flr) {
  if (!has_units(axes)) return std::nullopt;
  const Grid grid(axes, losses);
  UnitSpread spread{flr, without_unit(axes), shares_of(axes, losses, flr), std::nullopt, {}};
  const std::size_t abscissa = abscissa_of(spread.axes);
  if (abscissa == Ranking::none || spread.axes[abscissa].values.size() < 2) return spread;
  spread.abscissa = abscissa;
  spread.rows = range_rows(grid, spread);
  return spread;
}

std::optional<UnitSpread> unit_spread(const Dataset& data) {
  const Dataset::Variable* loss = find_variable(data, loss_name);
  return loss == nullptr ? std::nullopt : unit_spread(data.axes, numbers_of(*loss));
}

std::optional<UnitSpread> unit_spread(const LinkResult& result) {
  std::vector<double> losses;
  for (const LinkPoint& point : result.points)
    losses.push_back(frame_loss_ratio(point.tally, LinkResult::ci_level).value);
  return unit_spread(result.axes, losses);
}

std::vector<Axis> axes_of_rows(const UnitSpread& spread) {
  std::vector<Axis> axes = spread.axes;
  axes.erase(axes.begin() + static_cast<std::ptrdiff_t>(*spread.abscissa));
  return axes;
}

}  // namespace sim
