#include "sim/command/command_line.hpp"

#include "sim/capture/capture_file.hpp"
#include "sim/command/command_options.hpp"
#include "sim/command/commands.hpp"
#include "sim/engine/team.hpp"
#include "sim/scenario/keys.hpp"
#include "sim/text/number_text.hpp"

namespace sim {
namespace {

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
  run.add_option_function<std::string>(
         "--method",
         [&request](const std::string& name) {
           request.options.overrides.push_back("simulation.method=" + name);
         },
         "brute-force, or importance for errors too rare to wait for (the key simulation.method)")
      ->type_name("METHOD");
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
  run.add_flag("--profile", request.profile,
               "say on stderr where the time went, stage by stage; looking costs some of it")
      ->excludes("--resume");
  auto* plan = run.add_flag("--plan", request.plan,
                            "say how many frames and how much time each point is expected to take, "
                            "from a few trials of it, and stop there")
                   ->excludes("--resume");
  run.add_option("--time-budget", request.time_budget_s,
                 "choose --max-frames so that a scenario takes about so long: 90s, 10min, 2h")
      ->type_name("TIME")
      ->transform(a_time())
      ->excludes("--max-frames")
      ->excludes("--resume")
      ->excludes("--shard")
      ->excludes(plan);
  run.add_flag("-q,--quiet", request.quiet, "no progress on stderr");
  run.add_flag("--json", request.json, "one JSON object a scenario on stdout, not the table")
      ->excludes(plan);
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
            "file to write; its ending is the format: .vcd, the wires tx and rx; .sr, the same and "
            "all taps, for sigrok; .ook, the pulses of rx, for rtl_433; .csv, all taps, a row a "
            "sample; .h5, the same in HDF5, and spectra")
      ->required();
  add_scenario_options(trace, request.options);
  trace.footer("Example: cosys-sim trace scenarios/quickstart.toml --point 3 -o trial.vcd");
}

void add_encode(CLI::App& app, EncodeRequest& request) {
  auto& encode = *app.add_subcommand(
      "encode", "Print a message as the line carries it: with its checksum and line end");
  encode
      .add_option("MESSAGE", request.message,
                  "the message, without checksum; of sharedlink from its addresses on, the "
                  "receiver's first: "
                  "'AB|N0|D40.1'")
      ->required()
      ->type_name("");
  add_protocol(encode, request.protocol);
  encode.footer("Example: cosys-sim encode 'IND 011111 OK'");
}

void add_decode(CLI::App& app, DecodeRequest& request) {
  auto& decode = *app.add_subcommand(
      "decode",
      "Print the messages in a capture: when, accepted or why not, and their text; and "
      "how well the line keeps to its bit rate");
  add_place(decode, "CAPTURE", request.capture, "",
            "capture of the receiver's output or of its light: .vcd, .sr, .ook, .csv, .wav, "
            ".sigmf-meta or .bin")
      ->required();
  decode
      .add_option("--wire,--channel", request.wire,
                  "wire, channel or column to decode; if not given, rx, or the first where there "
                  "is none")
      ->type_name("NAME");
  decode.add_option("--format", request.format, "of the capture, where its name does not say it")
      ->type_name("NAME")
      ->check(CLI::IsMember(capture_format_names()).description(""));
  decode
      .add_option("--sample-rate", request.sample_rate_hz,
                  "samples a second, for a capture that does not say it")
      ->type_name("RATE")
      ->check(between(1, 1e12));
  decode
      .add_option(
          "--uart", request.uart,
          "the receiver: atmega (majority of three samples), mid-bit (one), software-serial "
          "(Arduino's) or edge-timing (widths of pulses); atmega if not given")
      ->type_name("NAME")
      ->check(CLI::IsMember(find_key("uart.receiver")->choices).description(""));
  decode
      .add_option_function<std::string>(
          "--baud", [&request](const std::string& text) { request.baud = parse_number(text); },
          "bits per second, 1 to 1000000; if not given or auto, found in the capture")
      ->type_name("RATE")
      ->check(auto_or_between(1, 1e6));
  decode
      .add_option_function<std::string>(
          "--carrier",
          [&request](const std::string& text) { request.carrier_hz = parse_number(text); },
          "of a sampled light, or of a baseband its distance from the middle, in Hz; 0 for a "
          "voltage; if not given or auto, found in the capture")
      ->type_name("HZ")
      ->check(auto_or_between(0, 1e9));
  decode
      .add_option("--polarity", request.polarity,
                  "idle-high (light is 0) or idle-low; if not given or auto, found in the capture")
      ->type_name("NAME")
      ->check(CLI::IsMember({"auto", "idle-high", "idle-low"}).description(""));
  add_protocol(decode, request.protocol);
  decode.add_flag("--json", request.json,
                  "one JSON object a line for each message, and a last one of the line");
  decode.footer("Example: cosys-sim decode trial.vcd --wire rx");
}

void add_node(CLI::App& app, NodeRequest& request) {
  auto& node = *app.add_subcommand(
      "node", "Be one end of a SharedLink at a serial device: mirror lists, ask and answer");
  add_place(node, "LISTS", request.lists, "", "who the node is, and its lists (.toml)")->required();
  auto* device = add_place(node, "--device", request.device, "DEV",
                           "serial device, or one end of a pseudo-terminal, to talk through");
  add_place(node, "--pty", request.pseudo_terminal, "LINK",
            "make a pseudo-terminal to talk through, and this link for the program at its other "
            "end; it is gone when the node ends")
      ->excludes(device);
  node.add_option("--baud", request.baud, "bits per second; those of LISTS, or 600, if not given")
      ->type_name("RATE")
      ->check(between(1, 1e9));
  node.add_option("--duration", request.duration_s,
                  "end after 90s, 10min or 2h; if not given, at a signal")
      ->type_name("TIME")
      ->transform(a_time());
  node.footer(
      "Reads lines from stdin: Name=value sets a variable, ?Name asks the peer for one. The end of "
      "stdin is not the node's. Prints a JSON line for every event. Example: cosys-sim node "
      "scenarios/nodes/guard.toml --device /dev/ttyUSB0");
}

void add_serve(CLI::App& app, ServeRequest& request) {
  auto& serve = *app.add_subcommand(
      "serve", "Play what a link's receiver hears on a virtual serial port, in real time");
  add_place(serve, "SCENARIO", request.scenario, "", "scenario file (.toml), one point")
      ->required();
  add_place(serve, "--link", request.link, "NAME", "name of the port; ttyCOSYS if not given");
  serve.add_option("--speed", request.settings.speed, "how many times real time; 1 if not given")
      ->type_name("X")
      ->check(between(1e-3, 1e6));
  serve.add_flag("--start-at-once", request.settings.start_at_once,
                 "do not wait until somebody opens the port; what comes before is lost");
  serve.add_flag("--drop-framing-errors", request.settings.drop_framing_errors,
                 "leave out bytes without a stop bit");
  serve
      .add_option("--duration", request.settings.duration.value,
                  "end after 90s, 10min or 2h of the line's time; or at \"quit\", or a signal")
      ->type_name("TIME")
      ->transform(a_time());
  add_scenario_options(serve, request.options);
  serve.add_flag("--json", request.json, "one JSON object a line for each message on stdout");
  serve.footer(
      "Reads lines from stdin: KEY=VALUE as of --set changes the scenario from the next message "
      "on, quit ends. Example: cosys-sim serve scenarios/quickstart.toml --set receiver.range_m=1");
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
                  "width of the bracket at which to stop, over its upper end; 0.01 if not given")
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

void add_locate(CLI::App& app, LocateRequest& request) {
  auto& locate = *app.add_subcommand(
      "locate", "Say where a device is by the light that receivers measured: place and ellipse");
  add_place(
      locate, "READINGS", request.readings, "",
      "readings (.csv): x_m, y_m, heading_deg, irradiance_mw_per_m2 or photocurrent_ua, sigma "
      "or relative_sigma; bearing_deg, bearing_sigma_deg if measured; or a scenario of location "
      "(.toml), of which one trial is drawn")
      ->required();
  locate.add_option("--led", request.led, "the device's LED; TSAL6200 if not given")
      ->type_name("NAME");
  locate.add_option("--led-current-ma", request.led_current_ma, "its current; 100 if not given")
      ->type_name("MA")
      ->check(between(1e-3, 1e4));
  locate
      .add_option("--led-yaw-deg", request.led_yaw_deg,
                  "where it looks, from +x to +y; if not given, it is as bright to all sides")
      ->type_name("DEG")
      ->check(between(-360, 360));
  locate.add_option("--floor", request.floor, "indoor if not given")->type_name("NAME");
  locate.add_option("--photodiode", request.photodiode, "the receivers'; BPW34 if not given")
      ->type_name("NAME");
  locate
      .add_option("--height-mm", request.height_mm,
                  "of LED and receivers above the floor; 10 if not given")
      ->type_name("MM")
      ->check(between(0.1, 1e4));
  locate
      .add_option("--area", request.area,
                  "where the device may be: x from, to, y from, to in metres, -3,3,0,5")
      ->type_name("X,X,Y,Y")
      ->delimiter(',')
      ->expected(4)
      ->check(between(-1e4, 1e4));
  locate.add_flag("--unknown-intensity", request.intensity_unknown,
                  "find the LED's intensity too, as a factor to the sheet's; needs --area");
  locate
      .add_option("--point", request.point,
                  "of a scenario: point of the sweep, counted from 0; 0 if not given")
      ->type_name("K")
      ->check(an_index);
  locate
      .add_option("--trial", request.trial, "of a scenario: trial, counted from 0; 0 if not given")
      ->type_name("N")
      ->check(an_index);
  add_scenario_options(locate, request.options);
  locate.add_flag("--json", request.json, "one JSON object on stdout, not text");
  locate.footer(
      "Exit code 4 if the readings leave it open. Example: cosys-sim locate "
      "scenarios/readings/four_receivers.csv");
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

std::vector<std::string> given_options(const CLI::App& command) {
  return names_of(command.get_options(
      [](const CLI::Option* option) { return option->count() > 0 && !option->get_positional(); }));
}

struct Requests {
  RunRequest run;
  TraceRequest trace;
  EncodeRequest encode;
  DecodeRequest decode;
  NodeRequest node;
  ServeRequest serve;
  PartsRequest parts;
  FindRequest find;
  LocateRequest locate;
  MergeRequest merge;
  DiffRequest diff;
};

void fill_in(Requests& to, const Surroundings& from) {
  to.run.command = to.find.command = to.merge.command = from.command;
  to.run.program = to.trace.program = to.find.program = to.merge.program = from.program;
  for (PartRoots* parts : {&to.run.options.parts, &to.trace.options.parts, &to.find.options.parts,
                           &to.parts.parts, &to.locate.options.parts, &to.serve.options.parts})
    parts->push_back(from.shipped_parts);
}

/// All commands but run would do the same in each process of a job, and write the same file.
bool is_alone() {
  const std::unique_ptr<Team> team = join_team();
  return together(team.get(), [&] {
    if (team != nullptr && team->size() > 1)
      throw bad_input("a job of several processes", "only cosys-sim run can share its work out",
                      "start this command without mpirun");
  });
}

ExitCode carry_out(const CLI::App& app, const Requests& requests) {
  if (app.got_subcommand("run")) return run_command(requests.run);
  if (!is_alone()) return ExitCode::done;
  if (app.got_subcommand("trace")) return trace_command(requests.trace);
  if (app.got_subcommand("encode")) return encode_command(requests.encode);
  if (app.got_subcommand("node")) return node_command(requests.node);
  if (app.got_subcommand("serve")) return serve_command(requests.serve);
  if (app.got_subcommand("parts")) return parts_command(requests.parts);
  if (app.got_subcommand("find")) return find_command(requests.find);
  if (app.got_subcommand("locate")) return locate_command(requests.locate);
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
  add_encode(app, requests.encode);
  add_decode(app, requests.decode);
  add_node(app, requests.node);
  add_serve(app, requests.serve);
  add_parts(app, requests.parts);
  add_find(app, requests.find);
  add_locate(app, requests.locate);
  add_merge(app, requests.merge);
  add_diff(app, requests.diff);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);
    throw wrong_usage(app, e);
  }
  fill_in(requests, surroundings);
  requests.locate.given = given_options(*app.get_subcommand("locate"));
  return static_cast<int>(carry_out(app, requests));
}

}  // namespace sim
