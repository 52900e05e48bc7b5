#include "sim/report/swept_maps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "sim/report/swept_curves.hpp"
#include "sim/scenario/sweep.hpp"

namespace sim {
namespace {

std::vector<std::string> value_texts(const Axis& axis) {
  std::vector<std::string> texts;
  for (const double value : axis.values) texts.push_back(coordinate_text(axis, value));
  return texts;
}

std::size_t index_of(const Axis& axis, double value) {
  return static_cast<std::size_t>(std::ranges::find(axis.values, value) - axis.values.begin());
}

HeatMap empty_map(const Axis& across, const Axis& up) {
  return {.title = {},
          .description = {},
          .x_label = axis_name(across),
          .y_label = axis_name(up),
          .columns = value_texts(across),
          .rows = value_texts(up),
          .values = {up.values.size(), std::vector<double>(across.values.size(), std::nan(""))},
          .texts = {up.values.size(), std::vector<std::string>(across.values.size(), "-")}};
}

/// The two numbers with the most values, or the one and the text with the most.
std::vector<std::size_t> axes_of_maps(const std::vector<Axis>& axes) {
  std::vector<std::size_t> over = widest_axes(axes);
  if (over.size() != 1) return over;
  std::size_t most = 1;
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (axes[i].is_text() && axes[i].values.size() > most) {
      most = axes[i].values.size();
      over.resize(1);
      over.push_back(i);
    }
  return over;
}

}  // namespace

std::vector<HeatMap> swept_maps(const std::vector<Axis>& axes, const std::vector<MapValue>& values,
                                const std::string& title, const std::string& what) {
  const std::vector<std::size_t> over = axes_of_maps(axes);
  if (over.size() < 2) return {};
  const Axis &across = axes[over[0]], &up = axes[over[1]];
  std::map<std::string, HeatMap> maps;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::vector<double> at = point_coordinates(axes, i);
    const std::string others = other_values(axes, {over[0], over[1]}, at);
    const auto [map, is_new] = maps.try_emplace(others, empty_map(across, up));
    if (is_new) {
      map->second.title = others.empty() ? title : fmt::format("{}, {}", title, others);
      map->second.description = fmt::format("{} over {} and {}", what, across.key, up.key);
    }
    const std::size_t row = index_of(up, at[over[1]]), column = index_of(across, at[over[0]]);
    map->second.values[row][column] = values[i].ratio;
    map->second.texts[row][column] = values[i].text;
  }
  std::vector<HeatMap> all;
  for (auto& [others, map] : maps) all.push_back(std::move(map));
  return all;
}

}  // namespace sim
