#pragma once
// What is said of a measured module: a table of its constants beside those of the module that it is
// like, and sentences; the same as JSON, and as a page with the recording beside what was fitted.
#include <string>

#include "channel/receiver_module.hpp"
#include "sim/fit/fitted_module.hpp"
#include "sim/page/page.hpp"

namespace sim {

struct MeasuredModule {
  FittedModule fit;
  Plan plan;
  channel::ModuleData like;
  std::string capture;         // the file's name
  std::string wire;            // of the module's output
  std::string plan_words;      // where the plan is from: "plan.txt"
  std::string first_level_by;  // where the irradiance is from: "--irradiance"; empty: not known
};

/// Whether the recording tells any number.
bool tells_something(const MeasuredModule& measured);

std::string measured_text(const MeasuredModule& measured);

/// One line.
std::string measured_json(const MeasuredModule& measured);

Page measured_page(const MeasuredModule& measured);

}  // namespace sim
