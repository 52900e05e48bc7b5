// Options of fit.
#include "sim/command/command_options.hpp"
#include "sim/command/commands_added.hpp"
#include "sim/fit/plan_schedule.hpp"

namespace sim {

void add_fit(CLI::App& app, FitRequest& request) {
  auto& fit = *app.add_subcommand(
      "fit",
      "Measure your own receiver module: write a plan for it, with a sketch for an Arduino that "
      "plays it and records the output, its wires, and what to set");
  fit.add_flag("--plan", request.plan, "write the plan, and what it takes to carry it out");
  add_place(fit, "-o,--output", request.output, "DIR",
            "folder for plan.txt, sketch/sketch.ino, wiring.svg and README.txt");
  fit.add_option("--minutes", request.minutes, "of light at most, 1 to 30; 5 if not given")
      ->type_name("M")
      ->check(between(least_minutes, most_minutes));
  fit.add_option("--module", request.module, "a module like yours; TSOP4856 if not given")
      ->type_name("NAME")
      ->check(a_name);
  add_part_folders(fit, request.parts);
  fit.footer("Example: cosys-sim fit --plan -o bench");
}

}  // namespace sim
