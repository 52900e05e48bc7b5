#include "sim/section/swept_maps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/scenario/sweep.hpp"
#include "sim/section/swept_curves.hpp"

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

/// Numbers grow upward, texts are read downward.
std::vector<std::string> row_texts(const Axis& axis) {
  std::vector<std::string> texts = value_texts(axis);
  if (axis.is_text()) std::ranges::reverse(texts);
  return texts;
}

std::size_t row_of(const Axis& axis, double value) {
  const std::size_t index = index_of(axis, value);
  return axis.is_text() ? axis.values.size() - 1 - index : index;
}

HeatMap empty_map(const Axis& across, const Axis& up) {
  return {.title = {},
          .description = {},
          .x_label = axis_name(across),
          .y_label = axis_name(up),
          .columns = value_texts(across),
          .rows = row_texts(up),
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

/// With the values on all other axes.
std::string title_of(const std::vector<Axis>& axes, const std::vector<std::size_t>& over,
                     const std::vector<double>& at, const std::string& title) {
  const std::string others = other_values(axes, {over[0], over[1]}, at);
  return others.empty() ? title : fmt::format("{}, {}", title, others);
}

/// The map of that title, which is added where there is none, as long as there are not too many.
HeatMap* map_of(std::vector<HeatMap>& maps, const std::string& title, const Axis& across,
                const Axis& up) {
  constexpr std::size_t most = 12;
  const auto found = std::ranges::find(maps, title, &HeatMap::title);
  if (found != maps.end()) return &*found;
  if (maps.size() == most) return nullptr;
  maps.push_back(empty_map(across, up));
  maps.back().title = title;
  return &maps.back();
}

std::size_t number_of_maps(const std::vector<Axis>& axes, const std::vector<std::size_t>& over) {
  std::size_t maps = 1;
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (i != over[0] && i != over[1]) maps *= axes[i].values.size();
  return maps;
}

}  // namespace

std::vector<HeatMap> swept_maps(const std::vector<Axis>& axes, const std::vector<MapValue>& values,
                                const std::string& title, const std::string& what) {
  const std::vector<std::size_t> over = axes_of_maps(axes);
  if (over.size() < 2 || values.empty()) return {};
  const Axis &across = axes[over[0]], &up = axes[over[1]];
  std::vector<HeatMap> maps;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::vector<double> at = point_coordinates(axes, i);
    HeatMap* map = map_of(maps, title_of(axes, over, at, title), across, up);
    if (map == nullptr) continue;
    map->description = fmt::format("{} over {} and {}", what, across.key, up.key);
    const std::size_t row = row_of(up, at[over[1]]), column = index_of(across, at[over[0]]);
    map->values[row][column] = values[i].ratio;
    map->texts[row][column] = values[i].text;
  }
  const std::size_t all = number_of_maps(axes, over);
  if (all > maps.size())
    maps.back().description +=
        fmt::format("; the last of {} maps that are shown, of {}", maps.size(), all);
  return maps;
}

}  // namespace sim
