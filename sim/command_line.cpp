#include "sim/command_line.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <map>

#include "sim/commands.hpp"
#include "sim/key_check.hpp"
#include "sim/keys.hpp"
#include "sim/sweep.hpp"

namespace sim {
namespace {

// Checks say what is wrong in the error line; the help has its own words (hence no description).
const CLI::Validator a_name([](const std::string& text) { return text.empty() ? "is empty" : ""; },
                            "");
const CLI::Validator an_index(
    [](const std::string& text) {
      const bool digits = text.find_first_not_of("0123456789") == std::string::npos;
      return digits ? "" : text + " is not a whole number, counted from 0";
    },
    "");

const CLI::Validator a_shard(
    [](const std::string& text) {
      return parse_shard(text)
                 ? ""
                 : fmt::format("{} is no shard K/N, with K from 1 to N and N up to {}", text,
                               most_shards);
    },
    "");

const std::map<std::string, double> seconds_in{{"s", 1}, {"min", 60}, {"h", 3600}};

/// CLI::Range lets NaN pass.
CLI::Validator between(double low, double high) {
  return {[=](const std::string& text) {
            const auto value = parse_number(text);
            const bool inside = value && *value >= low && *value <= high;
            return inside ? "" : fmt::format("{} is no number from {} to {}", text, low, high);
          },
          ""};
}

/// An option or argument that names files or folders.
template <class Place>
CLI::Option* add_place(CLI::App& app, const char* name, Place& place, const char* type,
                       const char* what) {
  return app.add_option(name, place, what)->type_name(type)->check(a_name);
}

/// Throws for what --set would refuse, but under the name of the option that was typed.
void check_short_form(const std::string& name, const std::string& value, const std::string& place) {
  const Key& key = *find_key(name);
  const std::string problem = name + " = " + value + " " + place;
  const bool whole = key.facts.type == KeyType::whole_number;
  if (!parse_number(value) && !is_range_or_list(value))
    throw bad_input(
        problem, "not a number",
        std::string("use a ") + (whole ? "whole " : "") + "number " + in_words(key.facts.range));
  make_axis(key, parse_values(value, problem), place);
}

/// A short form of --set: `--seed 7` is `--set simulation.seed=7`, and is recorded as such.
void add_short_form(CLI::App& app, const std::string& names, const char* key,
                    std::vector<std::string>& overrides, const std::string& what) {
  const std::string place = "in " + names.substr(names.find("--"));
  app.add_option_function<std::string>(
         names,
         [&overrides, key, place](const std::string& value) {
           check_short_form(key, value, place);
           overrides.push_back(std::string(key) + "=" + value);
         },
         what + " (the key " + key + ")")
      ->type_name("N");
}

/// Folders of parts that come before the program's own.
void add_part_folders(CLI::App& app, PartRoots& parts) {
  app.add_option("--parts", parts,
                 "a folder with modules/, leds/ or floors/ of your own; may be given several times")
      ->type_name("DIR")
      ->expected(1)
      ->check(CLI::ExistingDirectory.description(""))
      ->take_all();
}

void add_scenario_options(CLI::App& app, ScenarioOptions& options) {
  app.add_option("--set", options.overrides,
                 "change a key of the scenario: receiver.range_m=3, a range or list sweeps it: "
                 "receiver.range_m=1:0.5:20 or =1,2,5; may be given several times")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all();
  add_part_folders(app, options.parts);
  add_short_form(app, "-S,--seed", "simulation.seed", options.overrides, "seed of all randomness");
}

void add_protocol(CLI::App& app) {
  app.add_option_function<std::string>(
         "--protocol", [](const std::string&) {}, "format of the messages: cosys, the only one")
      ->type_name("NAME")
      ->check(CLI::IsMember({"cosys"}).description(""));
}

void add_threads(CLI::App& app, int& threads) {
  app.add_option("-t,--threads", threads,
                 "threads, 1 to 1024; if not given, one for each processor; the results are the "
                 "same for any number")
      ->type_name("N")
      ->check(CLI::Range(1, 1024).description(""));
}

void add_max_frames(CLI::App& app, ScenarioOptions& options) {
  add_short_form(app, "-n,--max-frames", "stop.max_frames", options.overrides,
                 "frames after which a point is finished");
}

void add_run(CLI::App& app, RunRequest& request) {
  auto& run = *app.add_subcommand(
      "run", "Run scenarios, single points or sweeps: table on stdout, counts in a result file");
  add_place(run, "SCENARIO", request.scenarios, "", "scenario files (.toml)")->required();
  add_place(run, "-o,--output", request.output, "OUT.h5|DIR/",
            "result file (HDF5), or a folder that gets one for each scenario; if not given, the "
            "scenario's name ending in .h5, in the current folder");
  add_scenario_options(run, request.options);
  add_threads(run, request.threads);
  add_max_frames(run, request.options);
  add_short_form(run, "-e,--max-frame-errors", "stop.max_frame_errors", request.options.overrides,
                 "lost frames after which a point is finished, 0 for no such limit");
  add_short_form(run, "--rel-ci", "stop.rel_ci", request.options.overrides,
                 "relative half width of the bit error ratio's interval at which a point is "
                 "finished, such as 0.1; 0 for no such rule");
  add_short_form(run, "--target-flr", "stop.target_flr", request.options.overrides,
                 "frame loss ratio; a point is finished when its own is surely below or above");
  run.add_flag("--resume", request.resume,
               "go on with what an interrupted run of the same command left in its result file; "
               "the counts are those of a run without interrupt");
  run.add_option_function<std::string>(
         "--shard", [&request](const std::string& text) { request.shard = *parse_shard(text); },
         "run the Kth of N shares of each point's trials, to be added up by merge; the result file "
         "is SCENARIO-KofN.h5 if not given")
      ->type_name("K/N")
      ->check(a_shard);
  auto* plan = run.add_flag("--plan", request.plan,
                            "say how many frames and how much time each point is expected to take, "
                            "from a few trials of it, and stop there");
  run.add_option("--time-budget", request.time_budget_s,
                 "choose --max-frames so that a scenario takes about so long: 90s, 10min, 2h")
      ->type_name("TIME")
      ->transform(
          CLI::AsNumberWithUnit(seconds_in, CLI::AsNumberWithUnit::UNIT_REQUIRED).description(""))
      ->check(between(0.1, 1e9))
      ->excludes("--resume")
      ->excludes("--shard")
      ->excludes(plan);
  run.add_flag("-q,--quiet", request.quiet, "no progress on stderr");
  run.add_flag("--json", request.json, "one JSON object a scenario on stdout, not the table");
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
      ->check(an_index);
  add_place(trace, "-o,--output", request.output, "FILE",
            "file to write; its ending is the format: .vcd, the wires tx and rx; .csv, all taps, a "
            "row a sample; .h5, the same in HDF5, and spectra")
      ->required();
  add_scenario_options(trace, request.options);
  trace.footer("Example: cosys-sim trace scenarios/quickstart.toml --point 3 -o trial.vcd");
}

void add_encode(CLI::App& app, std::string& message) {
  auto& encode = *app.add_subcommand(
      "encode", "Print a device's message as the line carries it: with its checksum and line end");
  encode.add_option("MESSAGE", message, "the message, without checksum")->required()->type_name("");
  add_protocol(encode);
  encode.footer("Example: cosys-sim encode 'IND 011111 OK'");
}

void add_decode(CLI::App& app, DecodeRequest& request) {
  auto& decode = *app.add_subcommand(
      "decode", "Print the messages in a logic capture: when, accepted or why not, and their text");
  add_place(decode, "CAPTURE", request.capture, "", "logic capture of the receiver's output (.vcd)")
      ->required();
  decode
      .add_option("--wire", request.wire,
                  "wire to decode; if not given, rx, or the first where there is none")
      ->type_name("NAME");
  decode
      .add_option("--uart", request.uart,
                  "how bits are sampled: mid-bit (once, in the middle) or atmega (majority of "
                  "three, as in a run); atmega if not given")
      ->type_name("NAME")
      ->check(CLI::IsMember(find_key("uart.receiver")->choices).description(""));
  decode.add_option("--baud", request.baud, "bits per second, 1 to 1000000; 600 if not given")
      ->type_name("RATE")
      ->check(between(1, 1e6));
  add_protocol(decode);
  decode.add_flag("--json", request.json, "one JSON object a line for each message");
  decode.footer("Example: cosys-sim decode trial.vcd --wire rx");
}

void add_parts(CLI::App& app, PartsRequest& request) {
  auto& parts = *app.add_subcommand(
      "parts", "List modules, LEDs, floors and photodiodes, or show one with all its sources");
  parts
      .add_option("NAME", request.name,
                  "the part to show: its numbers, and the model beside the data sheet's curves")
      ->type_name("");
  parts.add_option("--search", request.search, "list only parts whose file mentions this")
      ->type_name("TEXT");
  add_part_folders(parts, request.parts);
  parts.add_flag("--json", request.json, "JSON on stdout, not text");
  parts.footer("Example: cosys-sim parts TSOP4856");
}

void add_find(CLI::App& app, FindRequest& request) {
  auto& find = *app.add_subcommand(
      "find", "Find where along a key the frame loss passes a level, in fewer frames than a sweep");
  add_place(find, "SCENARIO", request.scenario, "", "scenario file (.toml)")->required();
  find.add_option("--over", request.over,
                  "the key and its range, receiver.range_m=1:40, or the key alone if the scenario "
                  "sweeps it; other sweeps of the scenario are a search each")
      ->type_name("KEY=LOW:HIGH")
      ->required()
      ->check(a_name);
  find.add_option("--flr", request.flr, "frame loss ratio to be found; 0.01 if not given")
      ->type_name("P")
      ->check(between(1e-9, 0.99));
  find.add_option("--tolerance", request.tolerance,
                  "width of the bracket at which to stop, relative; 0.01 if not given")
      ->type_name("R")
      ->check(between(1e-9, 1));
  add_place(find, "-o,--output", request.output, "OUT.h5",
            "result file (HDF5) of all points looked at; SCENARIO-find.h5 if not given");
  add_scenario_options(find, request.options);
  add_threads(find, request.threads);
  add_max_frames(find, request.options);
  find.add_flag("--json", request.json, "one JSON object on stdout, not the table");
  find.footer("Example: cosys-sim find scenarios/quickstart.toml --over receiver.range_m");
}

void add_merge(CLI::App& app, MergeRequest& request) {
  auto& merge = *app.add_subcommand(
      "merge", "Add results of other trials of the same command up: those of run --shard");
  add_place(merge, "RESULT", request.results, "", "result files (.h5)")->required();
  add_place(merge, "-o,--output", request.output, "OUT.h5", "result file to write")->required();
  merge.footer("Example: cosys-sim merge quickstart-1of2.h5 quickstart-2of2.h5 -o quickstart.h5");
}

void add_diff(CLI::App& app, DiffRequest& request) {
  auto& diff = *app.add_subcommand(
      "diff", "Say whether two results of the same sweep are equal, compatible or different");
  add_place(diff, "A", request.one, "", "result file")->required();
  add_place(diff, "B", request.other, "", "result file to compare it with")->required();
  diff.add_option("--alpha", request.alpha,
                  "probability of calling equals different, all points together; 0.01 if not given")
      ->type_name("P")
      ->check(between(1e-12, 0.5));
  diff.footer("Exit code 1 if they are different. Example: cosys-sim diff yesterday.h5 today.h5");
}

std::vector<std::string> names_of(const std::vector<const CLI::Option*>& options) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options)
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::vector<std::string> names_of(const std::vector<const CLI::App*>& commands) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands) names.push_back(command->get_name());
  return names;
}

Failure not_known(const CLI::App& command, const std::string& argument) {
  if (argument.starts_with("-"))
    return bad_input(argument, command.get_name() + " has no such option",
                     "did you mean " + nearest(argument, names_of(command.get_options())) + "?");
  const std::vector<const CLI::App*> commands = command.get_subcommands({});
  if (commands.empty())
    return bad_input(argument, command.get_name() + " does not take another argument",
                     "leave it out or quote what belongs together");
  return bad_input(argument, "no such command",
                   "did you mean " + nearest(argument, names_of(commands)) + "?");
}

/// The one line that answers a command line which cannot be read.
Failure wrong_usage(const CLI::App& app, const CLI::ParseError& error) {
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  const CLI::App& command = chosen.empty() ? app : *chosen.front();
  const std::vector<std::string> unread = app.remaining(true);
  if (!unread.empty()) return not_known(command, unread.front());
  const std::string name = chosen.empty() ? "" : " " + command.get_name();
  return bad_input(error.what(), "wrong usage", "see cosys-sim" + name + " --help");
}

struct Requests {
  RunRequest run;
  TraceRequest trace;
  std::string message;
  DecodeRequest decode;
  PartsRequest parts;
  FindRequest find;
  MergeRequest merge;
  DiffRequest diff;
};

void fill_in(Requests& to, const Surroundings& from) {
  to.run.command = to.find.command = to.merge.command = from.command;
  to.run.program = to.trace.program = to.find.program = from.program;
  for (PartRoots* parts :
       {&to.run.options.parts, &to.trace.options.parts, &to.find.options.parts, &to.parts.parts})
    parts->push_back(from.shipped_parts);
}

ExitCode carry_out(const CLI::App& app, const Requests& requests) {
  if (app.got_subcommand("run")) return run_command(requests.run);
  if (app.got_subcommand("trace")) return trace_command(requests.trace);
  if (app.got_subcommand("encode")) return encode_command(requests.message);
  if (app.got_subcommand("parts")) return parts_command(requests.parts);
  if (app.got_subcommand("find")) return find_command(requests.find);
  if (app.got_subcommand("merge")) return merge_command(requests.merge);
  if (app.got_subcommand("diff")) return diff_command(requests.diff);
  return decode_command(requests.decode);
}

}  // namespace

int run_command_line(int argc, char** argv, const Surroundings& surroundings) {
  const ProgramInfo& program = surroundings.program;
  CLI::App app{"Bit-level physical-layer simulator of 59 kHz infrared links", program.name};
  app.set_version_flag("--version",
                       program.name + " " + program.version + " (" + program.commit + ")");
  app.require_subcommand(1);
  Requests requests;
  add_run(app, requests.run);
  add_trace(app, requests.trace);
  add_encode(app, requests.message);
  add_decode(app, requests.decode);
  add_parts(app, requests.parts);
  add_find(app, requests.find);
  add_merge(app, requests.merge);
  add_diff(app, requests.diff);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);
    throw wrong_usage(app, e);
  }
  fill_in(requests, surroundings);
  return static_cast<int>(carry_out(app, requests));
}

}  // namespace sim
