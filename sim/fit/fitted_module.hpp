#pragma once
// A module's constants by what its output made of a plan's light: maximum likelihood on the pulses,
// with levels that are known to a few per cent only.
#include <cstddef>
#include <string>
#include <vector>

#include "channel/receiver_module.hpp"
#include "sim/fit/pin_recording.hpp"
#include "sim/fit/plan_text.hpp"

namespace sim {

/// A number of a part file, and how sure it is.
struct FittedNumber {
  std::string key;           // of a part file: "agc_attack_db_per_ms"
  double value = 0;          // the most likely
  double low = 0, high = 0;  // of 95 %
  bool is_told = false;      // by this recording; else the number of the module like it holds
  std::string more;          // which light would tell it, where it is not told
};

/// Steps of one kind: what the pin did and what the fitted rule says.
struct FittedStep {
  std::size_t step = 0;             // its place in the plan
  double recorded = 0, fitted = 0;  // in `unit`
  double deviation = 0;             // of the two, in its standard deviations
  std::string quantity;             // "time until the output lets go"
  std::string unit;                 // "ms", "cycle", "1"
};

/// Where the part does not follow the rule.
struct FitMisfit {
  std::string what;         // a FittedStep's quantity
  std::string by_how_much;  // "+12.1 bursts beside the rule in 6 of 9 steps"
};

struct FittedModule {
  channel::ModuleData module;         // every number of `like` that is not told, the fitted others
  std::vector<FittedNumber> numbers;  // in the order of a part file
  std::vector<FittedStep> steps;
  std::vector<std::string> not_apart;  // sentences, without their full stop
  std::vector<FitMisfit> misfits;      // none: the part follows the rule
  double first_level_mw_per_m2 = 0;    // irradiance of the plan's first step
  double clock_error = 0;              // of the recording's against the plan's, as a share
  double start_s = 0;                  // of the plan, in the recording's time
  double usual_deviation = 0;          // of all that was fitted, in standard deviations
};

struct FitSettings {
  /// Irradiance of the plan's first step at the module; 0: not known, so Emin is that of `like` and
  /// all levels are relative to it.
  double first_level_mw_per_m2 = 0;
  /// Standard deviation of a level against another one, as a share.
  double level_error = 0.07;
};

/// Throws Failure(bad_input) where the recording and the plan have nothing in common.
FittedModule fit_module(const Plan& plan, const PinRecording& recording,
                        const channel::ModuleData& like, const FitSettings& settings);

}  // namespace sim
