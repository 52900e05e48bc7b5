#pragma once
// Plan: which light a receiver module is shown, and when; a text of a line a step that anybody can
// write. Version 1: '#' begins a comment, empty lines are allowed, fields are separated by blanks,
// tabs or commas:
//
//   start_ms carrier_hz cycles_on cycles_off repeats level_db
//
// A step is `repeats` bursts of `cycles_on` carrier cycles, each followed by `cycles_off` cycles of
// dark; of one burst alone these may be 0. Steps come in order of time and do not overlap. Levels
// are relative to the first step's: 20 log10 of the ratio of irradiances, so twice the distance is
// -6 dB twice: -12 dB.
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sim {

struct PlanStep {
  double start_ms = 0;  // of the first cycle
  double carrier_hz = 0;
  std::uint64_t cycles_on = 0;
  std::uint64_t cycles_off = 0;
  std::uint64_t repeats = 1;
  double level_db = 0;  // relative to the first step

  bool operator==(const PlanStep&) const = default;
};

struct Plan {
  std::vector<PlanStep> steps;  // at least one

  bool operator==(const Plan&) const = default;
};

/// When the step is over, with the dark behind its last burst.
double end_ms(const PlanStep& step);

/// The text, its head included. `remarks` are lines of the head without their '#': what a reader
/// of this plan needs beside the format. Numbers are written so that they are read as the same.
std::string plan_text(const Plan& plan, const std::vector<std::string>& remarks);

/// The plan in a text; levels are made relative to the first step. Throws Failure(bad_input) with
/// the line of what is wrong; `file` names the text.
Plan plan_of_text(std::string_view text, const std::string& file);

/// The same of a file of at most 16 MiB.
Plan read_plan(const std::filesystem::path& path);

/// Whether a text begins as plan_text() does.
bool is_written_plan_text(std::string_view text);

}  // namespace sim
