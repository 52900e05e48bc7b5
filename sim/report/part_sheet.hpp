#pragma once
// The sheet of a part: all that its file says, each number with its unit and source, and the model
// beside each digitised figure that the file names.
#include <optional>
#include <string>
#include <vector>

#include "channel/curve.hpp"
#include "channel/number_bounds.hpp"
#include "sim/components/digitised_curve.hpp"
#include "sim/components/parts.hpp"
#include "sim/scenario/figures.hpp"

namespace sim {

/// A number of the part. `source` is empty where the file leaves the number to its default.
struct SheetNumber {
  std::string name, unit, long_name, source;
  double value = 0;
  std::optional<channel::NumberBounds> bounds{};  // where no document prints it
  std::string bounds_reason{};                    // where the file does not give them
};

struct SheetText {
  std::string name, value, long_name;
};

struct SheetCurve {
  std::string name, long_name, source;
  std::string x_name, x_unit, y_name, y_unit;
  channel::Curve points;
};

/// A figure of the data sheet with what the model makes of it at the same abscissae.
struct Comparison {
  FigureFacts figure;
  DigitisedCurve sheet;
  std::vector<double> model;  // NaN where it has no value

  /// Model less sheet at a point: in the unit of y, or as a share of the sheet's value where y is
  /// logarithmic.
  double deviation(std::size_t i) const;
  /// Magnitudes of all deviations that are known.
  std::vector<double> known_deviations() const;
  /// Root mean square of them.
  double rms_deviation() const;
  /// Median of their magnitudes: what a step that the model makes a point too late leaves alone.
  double median_deviation() const;
  /// The median deviation as a share of the sheet's value; NaN where one of these is not above 0.
  double median_share() const;
};

struct PartSheet {
  std::string kind, name;
  std::filesystem::path path;
  std::vector<std::string> about;  // the comment lines that open the file
  std::string summary;             // one line
  std::vector<SheetText> texts;
  std::vector<SheetNumber> numbers;
  std::vector<SheetCurve> curves;
  std::vector<Comparison> comparisons;
};

enum class Compare { no, yes };

/// Reads the part, and if asked runs the model for every figure that it names. Parts that it is
/// like are looked for beside it, and then in the folders.
PartSheet read_part_sheet(const PartFile& file, const PartRoots& folders, Compare whether);

}  // namespace sim
