#pragma once
// A small plot in characters: a data sheet's curve and the model's, for a terminal.
#include <string>
#include <vector>

#include "sim/scenario/figures.hpp"

namespace sim {

/// Two curves over the same abscissae; a value that is not finite is left out.
struct PlottedCurves {
  std::vector<double> x, sheet, model;
};

/// 18 lines, each ended by a newline: 'o' is the sheet, 'x' the model, '*' both. A logarithmic axis
/// leaves out what is not positive.
std::string text_plot(const FigureAxis& x, const FigureAxis& y, const PlottedCurves& curves);

}  // namespace sim
