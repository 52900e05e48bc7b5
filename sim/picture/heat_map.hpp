#pragma once
// A ratio over two swept numbers: a cell for each pair of values, coloured by its decade, with the
// line where it passes 1 %.
#include <string>
#include <vector>

namespace sim {

struct HeatMap {
  std::string title, description;
  std::string x_label, y_label;             // with their units
  std::vector<std::string> columns, rows;   // at least one each; the first row is the lowest
  std::vector<std::vector<double>> values;  // of rows; a ratio each, NaN where nothing is known
  /// What its table says of each, with intervals; empty: the values.
  std::vector<std::vector<std::string>> texts{};
  bool has_contour = true;  // where it passes 1 %
};

/// As SVG.
std::string heat_map_as_svg(const HeatMap& map);

}  // namespace sim
