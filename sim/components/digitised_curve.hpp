#pragma once
// Digitised curves: FOLDER/curves/NAME.csv, what a figure of a data sheet shows. The first line is
// a comment with document, revision, figure and units, the second names the columns, the rest are
// points.
#include <filesystem>
#include <string>
#include <vector>

namespace sim {

struct DigitisedCurve {
  std::string source;  // the first line, without its "#"
  std::vector<double> x, y;
};

/// Throws Failure(bad_input) for a file that is missing or of another form.
DigitisedCurve read_digitised_curve(const std::filesystem::path& path);

}  // namespace sim
