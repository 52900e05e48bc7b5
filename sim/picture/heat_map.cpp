#include "sim/picture/heat_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "sim/picture/svg.hpp"

namespace sim {
namespace {

// Pixels.
constexpr double map_width = 720, map_left = 120, map_top = 50, map_right = 560,
                 map_legend_left = 590;
constexpr double row_height = 26, map_legend_step = 22, map_patch = 14;

struct Shade {
  double greatest;
  const char* style;
  const char* name;
};

/// From dark to light, as viridis has them: told apart by everybody, and in grey.
constexpr std::array shades{Shade{0, "heat0", "none seen"}, Shade{1e-3, "heat1", "to 0.1 %"},
                            Shade{1e-2, "heat2", "to 1 %"}, Shade{3e-2, "heat3", "to 3 %"},
                            Shade{0.1, "heat4", "to 10 %"}, Shade{0.3, "heat5", "to 30 %"},
                            Shade{0.9, "heat6", "to 90 %"}, Shade{2, "heat7", "over 90 %"}};
constexpr double contour = 1e-2;

const Shade& shade_of(double ratio) {
  const auto shade =
      std::ranges::find_if(shades, [&](const Shade& each) { return ratio <= each.greatest; });
  return shade == shades.end() ? shades.back() : *shade;
}

class Cells {
 public:
  explicit Cells(const HeatMap& map)
      : map_(map), cell_width_((map_right - map_left) / static_cast<double>(map.columns.size())) {}

  double x(std::size_t column) const {
    return map_left + cell_width_ * static_cast<double>(column);
  }
  /// The upper edge; that of the row -1 below is the bottom.
  double y(std::size_t row) const {
    return map_top + row_height * static_cast<double>(map_.rows.size() - 1 - row);
  }
  double bottom() const { return map_top + row_height * static_cast<double>(map_.rows.size()); }
  double cell_width() const { return cell_width_; }

  bool passes(std::size_t row, std::size_t column) const {
    return map_.values[row][column] > contour;  // not where nothing is known
  }
  bool known(std::size_t row, std::size_t column) const {
    return !std::isnan(map_.values[row][column]);
  }
  /// Whether the line goes between two cells.
  bool parts(std::size_t row, std::size_t column, std::size_t row2, std::size_t column2) const {
    return known(row, column) && known(row2, column2) &&
           passes(row, column) != passes(row2, column2);
  }

 private:
  const HeatMap& map_;
  double cell_width_;
};

void draw_cells(SvgDrawing& drawing, const HeatMap& map, const Cells& cells) {
  for (std::size_t r = 0; r < map.rows.size(); ++r)
    for (std::size_t c = 0; c < map.columns.size(); ++c)
      drawing.rectangle({cells.x(c), cells.y(r)}, cells.cell_width(), row_height,
                        cells.known(r, c) ? shade_of(map.values[r][c]).style : "frame");
}

void draw_contour(SvgDrawing& drawing, const HeatMap& map, const Cells& cells) {
  std::string path;
  for (std::size_t r = 0; r < map.rows.size(); ++r)
    for (std::size_t c = 0; c < map.columns.size(); ++c) {
      if (c > 0 && cells.parts(r, c - 1, r, c))
        path += fmt::format("M{:.2f} {:.2f}v{}", cells.x(c), cells.y(r), row_height);
      if (r > 0 && cells.parts(r - 1, c, r, c))
        path += fmt::format("M{:.2f} {:.2f}h{:.2f}", cells.x(c), cells.y(r) + row_height,
                            cells.cell_width());
    }
  drawing.path(path, "contour");
}

/// At most so many labels of columns fit beside each other.
std::size_t label_step(const HeatMap& map) {
  constexpr std::size_t most = 10;
  return (map.columns.size() + most - 1) / most;
}

void draw_labels(SvgDrawing& drawing, const HeatMap& map, const Cells& cells) {
  for (std::size_t r = 0; r < map.rows.size(); ++r)
    drawing.text({map_left - 8, cells.y(r) + row_height / 2 + 4}, map.rows[r], "end small");
  for (std::size_t c = 0; c < map.columns.size(); c += label_step(map))
    drawing.text({cells.x(c) + cells.cell_width() / 2, cells.bottom() + 18}, map.columns[c],
                 "middle small");
  drawing.text({(map_left + map_right) / 2, cells.bottom() + 42}, map.x_label, "middle");
  drawing.text({20, map_top - 12}, map.y_label, "");
  drawing.text({20, 20}, map.title, "heading");
}

void draw_map_legend(SvgDrawing& drawing, bool has_contour) {
  double y = map_top;
  for (const Shade& shade : shades) {
    drawing.rectangle({map_legend_left, y}, map_patch, map_patch, shade.style);
    drawing.text({map_legend_left + map_patch + 8, y + map_patch - 3}, shade.name, "");
    y += map_legend_step;
  }
  if (!has_contour) return;
  drawing.path(fmt::format("M{} {}h{}", map_legend_left, y + map_patch / 2, map_patch), "contour");
  drawing.text({map_legend_left + map_patch + 8, y + map_patch - 3}, "found to pass 1 %", "");
}

}  // namespace

std::string heat_map_as_svg(const HeatMap& map) {
  const Cells cells(map);
  const double legend_bottom = map_top + map_legend_step * static_cast<double>(shades.size() + 1);
  SvgDrawing drawing(map_width, std::max(cells.bottom() + 60, legend_bottom + 20), map.title,
                     map.description);
  draw_cells(drawing, map, cells);
  if (map.has_contour) draw_contour(drawing, map, cells);
  draw_labels(drawing, map, cells);
  draw_map_legend(drawing, map.has_contour);
  return drawing.finished();
}

}  // namespace sim
