#pragma once
// Figures: the typical curves of data sheets that a part's model can be compared with, each with
// the way to draw it from the model. They judge the model and never feed it.
#include <functional>
#include <string>
#include <vector>

#include "channel/emitter.hpp"
#include "channel/receiver_module.hpp"

namespace sim {

struct FigureAxis {
  std::string name, unit;  // "irradiance", "mW/m2"; unit "1" for a plain number
  bool logarithmic = false;
};

/// What a figure plots, whatever part it is of.
struct FigureFacts {
  std::string name;   // as in a part's [figures]: "pulse_width"
  std::string title;  // "output less input width; bursts of 30 cycles every 10 ms"
  FigureAxis x, y;
};

template <class Data>
struct Figure {
  FigureFacts facts;
  std::function<double(const Data&, double)> model;  // y at an x; NaN where it has none
};

const std::vector<Figure<channel::ModuleData>>& module_figures();
const std::vector<Figure<channel::EmitterData>>& led_figures();

template <class Data>
std::vector<std::string> figure_names(const std::vector<Figure<Data>>& figures) {
  std::vector<std::string> names;
  for (const auto& figure : figures) names.push_back(figure.facts.name);
  return names;
}

}  // namespace sim
