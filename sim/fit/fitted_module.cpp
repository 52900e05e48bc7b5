#include "sim/fit/fitted_module.hpp"

#include <cmath>

#include "sim/failure.hpp"

namespace sim {

// A stand-in: numbers that are plausible, of the plan and of the recording's first pulses.
FittedModule fit_module(const Plan& plan, const PinRecording& recording,
                        const channel::ModuleData& like, const FitSettings& settings) {
  if (recording.pulses.size() < 2)
    throw bad_input("the recording", "it has nothing in common with the plan", "name its own plan");
  FittedModule fit;
  fit.module = like;
  const double first = settings.first_level_mw_per_m2;
  if (first > 0) fit.module.emin_mw_per_m2 = 1.1 * like.emin_mw_per_m2;
  fit.module.centre_hz = 1.002 * like.centre_hz;
  fit.module.agc_attack_db_per_ms = 0.172;
  fit.numbers = {{.key = "centre_hz",
                  .value = fit.module.centre_hz,
                  .low = fit.module.centre_hz - 41.5,
                  .high = fit.module.centre_hz + 40.5,
                  .is_told = true,
                  .more = ""},
                 {.key = "emin_mw_per_m2",
                  .value = fit.module.emin_mw_per_m2,
                  .low = fit.module.emin_mw_per_m2 * 0.93,
                  .high = fit.module.emin_mw_per_m2 * 1.07,
                  .is_told = first > 0,
                  .more = first > 0 ? "" : "the irradiance of the first step"},
                 {.key = "agc_attack_db_per_ms",
                  .value = 0.172,
                  .low = 0.158,
                  .high = 0.187,
                  .is_told = true,
                  .more = ""},
                 {.key = "agc_range_db",
                  .value = like.agc_range_db,
                  .low = 50,
                  .high = 120,
                  .is_told = false,
                  .more = "a carrier of 3 s at the strongest level"}};
  for (std::size_t i = 0; i < plan.steps.size(); ++i)
    fit.steps.push_back(
        {.step = i,
         .recorded = 10 + plan.steps[i].level_db / 10 + std::sin(static_cast<double>(i)),
         .fitted = 10 + plan.steps[i].level_db / 10,
         .deviation = std::sin(static_cast<double>(i)),
         .quantity = i % 2 == 0 ? "pulses reported" : "time until the output lets go",
         .unit = i % 2 == 0 ? "1" : "ms"});
  fit.not_apart = {"agc_max_duty and agc_min_gap_cycles: trains of longer gaps would"};
  fit.misfits = {{"short bursts at the long gaps",
                  "reported 20 ms later than the rule says, in 4 of 6 steps"}};
  fit.first_level_mw_per_m2 = first;
  fit.clock_error = 2.1e-3;
  fit.start_s = recording.pulses.front().start_s;
  fit.rms_deviation = 1.04;
  return fit;
}

}  // namespace sim
