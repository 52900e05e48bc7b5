// Options of run, trace, find, merge and diff.
#include "sim/command/command_options.hpp"
#include "sim/command/commands_added.hpp"
#include "sim/loading/parsed_scenario.hpp"
#include "sim/scenario/keys.hpp"

namespace sim {

namespace {

/// When a point is finished, and how its trials are drawn.
void add_stop_rules(CLI::App& run, RunRequest& request) {
  add_short_form(run, "-e,--max-frame-errors", "stop.max_frame_errors", request.options.overrides,
                 "lost frames after which a point is finished, 0 for no such limit");
  add_short_form(run, "--rel-ci", "stop.rel_ci", request.options.overrides,
                 "relative half width of the interval (of the bit error ratio, or of what another "
                 "experiment measures) at which a point is finished, such as 0.1; 0 for no such "
                 "rule");
  run.add_option_function<std::string>(
         "--method",
         [&request](const std::string& name) {
           request.options.overrides.push_back("simulation.method=" + name);
         },
         "brute-force, or importance for errors too rare to wait for (the key simulation.method)")
      ->type_name("METHOD")
      ->check(likely(find_key("simulation.method")->choices));
  add_short_form(run, "--target-flr", "stop.target_flr", request.options.overrides,
                 "frame loss ratio; a point is finished when its own is surely below or above");
}

}  // namespace

void add_run(CLI::App& app, RunRequest& request) {
  auto& run = *app.add_subcommand(
      "run", "Run scenarios, single points or sweeps: table on stdout, counts in a result file");
  add_place(run, "SCENARIO", request.scenarios, "", "scenario files (.toml)")->required();
  add_place(run, "-o,--output", request.output, "OUT.h5|DIR/",
            "result file: .h5 (HDF5), or a table in .csv or .json (JSON lines); or a folder for an "
            ".h5 of each scenario; SCENARIO.h5 if not given");
  add_scenario_options(run, request.options);
  add_threads(run, request.threads);
  add_amount(run, request.options);
  add_stop_rules(run, request);
  run.add_flag_callback(
         "--doubt", [&request] { request.options.overrides.emplace_back(doubt_option); },
         "run with 32 units in place of the parts: each has what nobody printed of them drawn "
         "within its bounds, and the answer is how many of them carry; of more units by --set "
         "receiver.unit=1:1:100 in place of this")
      ->disable_flag_override();
  run.add_flag("--resume", request.resume,
               "go on with what an interrupted run of the same command left in its result file; "
               "the counts are those of a run without interrupt");
  run.add_option_function<std::string>(
         "--shard", [&request](const std::string& text) { request.shard = *parse_shard(text); },
         "run the Kth of N shares of each point's trials, to be added up by merge; the result file "
         "is SCENARIO-KofN.h5 if not given")
      ->type_name("K/N")
      ->check(a_shard);
  run.add_flag("--plot", request.plot, "draw results over the swept number, as characters");
  run.add_flag("--profile", request.profile,
               "say on stderr where the time went, stage by stage; looking costs some of it")
      ->excludes("--resume");
  auto* plan =
      run.add_flag("--plan", request.plan,
                   "say how many frames or runs and how much time each point is expected to take, "
                   "from a few trials of it, and stop there")
          ->excludes("--resume");
  run.add_option("--time-budget", request.time_budget_s,
                 "choose --max-frames so that a scenario takes about so long: "
                 "90s, 10min, 2h")
      ->type_name("TIME")
      ->transform(a_time())
      ->excludes("--max-frames")
      ->excludes("--resume")
      ->excludes("--shard")
      ->excludes(plan);
  run.add_flag(
      "--table", request.table,
      "print a row for each point also of more than 40 on a terminal, which otherwise sees "
      "where the columns are least and greatest");
  run.add_flag("-q,--quiet", request.quiet, "no progress on stderr");
  run.add_flag("--json", request.json, "one JSON object a scenario on stdout, not the table")
      ->excludes(plan)
      ->excludes("--plot");
  run.footer("Example: cosys-sim run scenarios/quickstart.toml --set led.current_ma=20,50,100");
}

void add_trace(CLI::App& app, TraceRequest& request) {
  auto& trace = *app.add_subcommand(
      "trace", "Run one trial of a scenario again and write every tap of the receiver to a file");
  add_place(trace, "SCENARIO", request.scenario, "", "scenario file (.toml)")->required();
  trace.add_option("--point", request.point, "point of the sweep, counted from 0; 0 if not given")
      ->type_name("K")
      ->check(an_index);
  trace.add_option("--trial", request.trial, "trial, counted from 0; 0 if not given")
      ->type_name("N")
      ->check(an_index)
      ->check(between(0, last_trial));
  add_place(trace, "-o,--output", request.output, "FILE",
            "file to write; its ending is the format: .vcd, the wires tx and rx; .sr, the same "
            "for sigrok; .ook, the pulses of rx, for rtl_433; .bin, the wires, a byte a "
            "sample at 1 MHz; .csv, all taps, a row a sample; .h5, the same in HDF5, and spectra; "
            ".wav, the light; .sigmf-meta, the light and its baseband; .svg, a picture")
      ->required();
  trace
      .add_option("--pin", request.wishes.pin,
                  "name of the wire rx in .vcd and .sr, as iogD_2 for pin D2 of simavr; rx if not "
                  "given")
      ->type_name("NAME")
      ->check(a_wire_name);
  trace
      .add_option_function<double>(
          "--tail", [&request](double seconds) { request.wishes.tail = dsp::Seconds(seconds); },
          "how long the wires of .vcd, .sr, .ook and .bin go on after the trial, up to 10min, so "
          "that firmware has time to answer; not at all if not given")
      ->type_name("TIME")
      ->transform(a_time(600));
  trace.add_flag("--taps", request.wishes.taps, "all taps into .sr too, beside the wires");
  add_scenario_options(trace, request.options);
  trace.footer("Example: cosys-sim trace scenarios/quickstart.toml --point 3 -o trial.vcd");
}

void add_find(CLI::App& app, FindRequest& request) {
  auto& find = *app.add_subcommand(
      "find", "Find where along a key the frame loss passes a level, in fewer frames than a sweep");
  add_place(find, "SCENARIO", request.scenario, "", "scenario file (.toml)")->required();
  find.add_option("--over", request.over,
                  "the key and its range, receiver.range_m=1:40, or the key alone if the scenario "
                  "sweeps it; other sweeps of the scenario are a search each")
      ->type_name("KEY=LOW:HIGH")
      ->check(a_setting)
      ->required()
      ->check(a_name);
  find.add_option("--flr", request.flr, "frame loss ratio to be found; 0.01 if not given")
      ->type_name("P")
      ->check(between(1e-9, 0.99));
  find.add_option("--tolerance", request.tolerance,
                  "width of the bracket at which to stop, over its upper end; 0.01 if not given")
      ->type_name("R")
      ->check(between(1e-9, 1));
  add_place(find, "-o,--output", request.output, "OUT.h5",
            "result file of all points looked at, .h5 (HDF5), or a table in .csv or .json (JSON "
            "lines); SCENARIO-find.h5 if not given");
  add_scenario_options(find, request.options);
  add_threads(find, request.threads);
  add_amount(find, request.options);
  find.add_flag("--json", request.json, "one JSON object on stdout, not the table");
  find.footer("Example: cosys-sim find scenarios/quickstart.toml --over receiver.range_m");
}

void add_merge(CLI::App& app, MergeRequest& request) {
  auto& merge = *app.add_subcommand(
      "merge", "Add results of other trials of the same command up: those of run --shard");
  add_place(merge, "RESULT", request.results, "", "result files (.h5)")->required();
  add_place(merge, "-o,--output", request.output, "OUT.h5",
            "result file to write: .h5 (HDF5), or a table in .csv or .json (JSON lines); of one "
            "RESULT, too")
      ->required();
  merge.footer("Example: cosys-sim merge quickstart-1of2.h5 quickstart-2of2.h5 -o quickstart.h5");
}

void add_report(CLI::App& app, ReportRequest& request) {
  auto& report = *app.add_subcommand(
      "report", "Show results as pictures and tables in one HTML file that needs nothing else");
  add_place(report, "RESULT", request.results, "", "result files (.h5) that run wrote")->required();
  add_place(report, "-o,--output", request.output, "FILE",
            "file to write; report.html if not given");
  add_place(report, "--svg", request.pictures.svg, "DIR", "put each picture there too, as SVG");
  add_place(report, "--png", request.pictures.png, "DIR",
            "as PNG, two pixels for each of the SVG's; needs gnuplot");
  add_place(report, "--pdf", request.pictures.pdf, "OUT.pdf|DIR",
            "for print: at most four A4 pages; or in a folder each picture as PDF; needs gnuplot");
  add_threads(report, request.threads);
  report.footer("Example: cosys-sim report quickstart.h5 -o report.html");
}

void add_diff(CLI::App& app, DiffRequest& request) {
  auto& diff = *app.add_subcommand(
      "diff", "Say whether two results of the same sweep are equal, compatible or different");
  add_place(diff, "A", request.one, "", "result file (.h5)")->required();
  add_place(diff, "B", request.other, "", "result file (.h5) to compare it with")->required();
  diff.add_option("--alpha", request.alpha,
                  "probability of calling equals different, all points together; 0.01 if not given")
      ->type_name("P")
      ->check(between(1e-12, 0.5));
  diff.footer("Exit code 1 if they are different. Example: cosys-sim diff yesterday.h5 today.h5");
}

}  // namespace sim
