#pragma once
// What is said of a measured module: a table of its constants beside those of the module that it is
// like, and sentences; the same as JSON, and as a page with the recording beside what was fitted.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "channel/receiver_module.hpp"
#include "sim/fit/fit_result.hpp"
#include "sim/page/page.hpp"

namespace sim {

struct MeasuredCapture {
  std::string file;
  std::string wire;               // of the module's output
  std::string plan_words;         // where the plan is from: "the plan plan.txt"
  std::size_t steps = 0;          // of the plan
  double ambient_w_per_m2 = 0;    // of a lamp
  bool is_of_messages = false;    // the plan is what the module reports of messages
  bool is_of_drive = false;       // the plan is what the wire of the LED did
  bool is_of_known_level = true;  // its light was not to be found
  std::uint64_t lost_pairs = 0;   // of edges that the sketch of a bench says it has left out
};

struct MeasuredModule {
  FittedModule fit;
  channel::ModuleData like;
  std::vector<MeasuredCapture> captures;
  double first_level_mw_per_m2 = 0;      // of the first step of the first capture
  std::string first_level_by;            // where that is from: "--irradiance"; empty: not known
  bool is_first_level_measured = false;  // else it is that of a typical LED
};

/// "far.csv and near.csv".
std::string files_in_words(const std::vector<MeasuredCapture>& captures);

/// Whether the recording tells any number.
bool tells_something(const MeasuredModule& measured);

std::string measured_text(const MeasuredModule& measured);

/// One line.
std::string measured_json(const MeasuredModule& measured);

Page measured_page(const MeasuredModule& measured);

}  // namespace sim
