// Options of fit.
#include "protocol/cosys.hpp"
#include "sim/command/command_options.hpp"
#include "sim/command/commands_added.hpp"
#include "sim/command/read_usage.hpp"
#include "sim/fit/plan_schedule.hpp"

namespace sim {
namespace {

/// A file, or none where the option stands alone.
CLI::Validator a_place_or_none() {
  return CLI::Validator([](const std::string&) { return std::string(); }, "")
      .name(std::string(place_check));
}

CLI::Validator a_message() {
  return CLI::Validator(
      [](const std::string& text) { return protocol::problem_in_message(text).value_or(""); }, "");
}

void add_light(CLI::App& fit, FitRequest& request) {
  fit.add_option_function<std::string>(
         "--plan",
         [&request](const std::string& file) {
           request.plan = true;
           if (!file.empty()) request.plan_files.emplace_back(file);
         },
         "the light that the module was shown (.txt), for all captures or one for each; if not "
         "given plan.txt beside the capture, else what is on the LED's wire, else COSYS messages. "
         "Without a capture: write a plan, and what carries it out")
      ->expected(0, 1)
      ->trigger_on_parse()
      ->type_name("PLAN")
      ->check(a_place_or_none());
  fit.add_option("--drive", request.drive,
                 "wire that drives the LED, by pulses or a level; if not given, the other one of "
                 "two")
      ->type_name("NAME")
      ->check(a_name);
  fit.add_option("--carrier", request.carrier_hz,
                 "of the light in Hz, where that wire does not say it; that of --module if not "
                 "given")
      ->type_name("HZ")
      ->check(between(1e3, 1e7));
  fit.add_option(
         "--message", request.message,
         "that a device sent, without its checksum, where there is neither a plan nor a wire "
         "of the LED; if not given, the one that is most often whole")
      ->type_name("TEXT")
      ->check(a_message());
  fit.add_option("--baud", request.baud, "of those messages; 600 if not given")
      ->type_name("BD")
      ->check(between(1, 1e5));
  fit.add_option("--irradiance", request.irradiances_mw_per_m2,
                 "at the module in the plan's first step, of the first capture or, with commas, of "
                 "each; if not given, what the plan says, or --module's Emin")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("MW/M2")
      ->check(between(1e-6, 1e9));
  fit.add_option("--ambient", request.ambients_w_per_m2,
                 "of a lamp on the module, of each capture with commas; 0 for the first. One "
                 "without an irradiance of its own has the light of the first")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("W/M2")
      ->check(between(0, 1e4));
}

}  // namespace

void add_fit(CLI::App& app, FitRequest& request) {
  auto& fit = *app.add_subcommand(
      "fit",
      "Measure your own receiver module: write a plan of light for it, with a sketch for an "
      "Arduino that plays it and records the output; then find the module's constants in the "
      "recording, and write them as a part that scenarios name");
  add_place(fit, "CAPTURE", request.captures, "",
            "recording of the module's output, in a format that decode reads; several of one "
            "module (nearby, under a lamp) are fitted together; none to write a plan")
      ->expected(0, 1000);
  add_light(fit, request);
  add_place(fit, "-o,--output", request.output, "OUT",
            "part to write (.toml), best into a folder modules/; of --plan alone a folder");
  add_place(fit, "--page", request.page, "PAGE.html",
            "recording and fit as pictures and tables in one file");
  fit.add_option("--minutes", request.minutes, "of light at most, 1 to 30; 5 if not given")
      ->type_name("M")
      ->check(between(least_minutes, most_minutes));
  fit.add_option("--module", request.module, "a module like yours; TSOP4856 if not given")
      ->type_name("NAME")
      ->check(a_part_of("modules"))
      ->check(a_name);
  add_capture_options(fit, request, "that is the module's output");
  fit.add_option("--polarity", request.polarity,
                 "idle-high (light is 0) or idle-low; if not given or auto, found in the capture")
      ->type_name("NAME")
      ->check(one_of({"auto", "idle-high", "idle-low"}));
  add_part_folders(fit, request.parts);
  fit.add_flag("-q,--quiet", request.quiet, "no progress on stderr");
  fit.add_flag("--json", request.json, "one JSON object on stdout, not the table");
  fit.footer(
      "Exit code 4 if the recording tells no constant. Examples: cosys-sim fit --plan -o bench; "
      "cosys-sim fit capture.csv -o modules/mine.toml --page mine.html");
}

}  // namespace sim
