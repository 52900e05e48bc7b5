#pragma once
// What a fit finds: numbers of a part file, each with how sure it is, and what the recording has
// beside what they make of the plan.
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "channel/receiver_module.hpp"

namespace sim {

/// A number of a part file, and how sure it is.
struct FittedNumber {
  std::string key;           // of a part file: "agc_attack_db_per_ms"
  double value = 0;          // the most likely
  double low = 0, high = 0;  // of 95 %
  bool is_told = false;      // by this recording; else any part may have numbers from low to high
  std::string more;          // which light would tell it, where it is not told
};

/// How much a step says of the rule, where it is far off.
enum class StepEvidence {
  usual,
  first_bursts,  // of a train: chance does not move them
  way_back       // of seldom bursts right behind a carrier: only the gain's way back moves them
};

/// Steps of one kind: what the pin did and what the fitted rule says.
struct FittedStep {
  std::size_t capture = 0;          // which one
  std::size_t step = 0;             // its place in that one's plan
  double level_db = 0;              // over the first step of the first capture
  double recorded = 0, fitted = 0;  // in `unit`
  double deviation = 0;             // of the two, in its standard deviations
  std::string quantity;             // "time until the output lets go"
  std::string unit;                 // "ms", "cycle", "1"
  StepEvidence evidence = StepEvidence::usual;
  double carrier_hz = 0;
};

/// By how many cycles the output of short bursts at rest is longer than they are: at one of the
/// plan's levels the least, at another the most.
struct OutputWidth {
  double least_cycles = 0, most_cycles = 0;
};

/// Where the part does not follow the rule.
struct FitMisfit {
  std::string what;         // a FittedStep's quantity
  std::string by_how_much;  // "+12.1 bursts beside the rule in 6 of 9 steps"
};

/// When and how strong a capture's light was.
struct FittedCapture {
  double start_s = 0;      // of the plan, in the recording's time
  double clock_error = 0;  // of the recording's against the plan's, as a share
  double level_db = 0;     // over the first capture's light, as the module sees it under a lamp
  std::size_t fitted_steps = 0;  // of its plan, from the first one on
  bool is_cut_short = false;     // the recording ends before the plan
};

struct FittedModule {
  std::vector<FittedNumber> numbers;  // in the order of a part file
  std::vector<FittedStep> steps;
  std::vector<std::string> not_apart;  // sentences, without their full stop
  std::vector<FitMisfit> misfits;      // none: the part follows the rule
  std::vector<FittedCapture> captures;
  double strongest_db = 0;                         // level of the strongest light
  std::optional<double> strongest_over_emin_db{};  // nothing: the recording does not tell Emin
  std::optional<OutputWidth> output_width{};       // as recorded; nothing: no such burst is
  double usual_deviation = 0;                      // of all that was fitted, in standard deviations
};

}  // namespace sim
