// The command line: options in, one call of a command, an exit code out. Whatever goes wrong below
// is caught here, once, and said in one line.
#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>

#include "sim/commands.hpp"

namespace {

namespace fs = std::filesystem;

/// The program's own parts, in the build tree as where it is installed.
fs::path shipped_parts() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return program.parent_path().parent_path() / "share" / "cosys-sim";
}

std::string quoted(const std::string& argument) {
  if (!argument.empty() &&
      argument.find_first_of(" \t\n\"'\\$`*?[]{}()<>|&;#~!") == std::string::npos)
    return argument;
  std::string text = "'";
  for (const char c : argument) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string command_line(int argc, char** argv) {
  std::string text = "cosys-sim";
  for (int i = 1; i < argc; ++i) text += " " + quoted(argv[i]);
  return text;
}

/// A short form of --set: `--seed 7` is `--set simulation.seed=7`, and is recorded as such.
void add_short_form(CLI::App& app, const char* names, const char* key,
                    std::vector<std::string>& overrides, const char* what) {
  app.add_option_function<std::string>(
         names,
         [&overrides, key](const std::string& value) {
           overrides.push_back(std::string(key) + "=" + value);
         },
         what)
      ->type_name("N");
}

void add_scenario_options(CLI::App& app, sim::ScenarioOptions& options) {
  app.add_option("--set", options.overrides,
                 "set a scenario key: receiver.range_m=3, or sweep it: receiver.range_m=1:1:20")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all();
  app.add_option("--parts", options.parts, "a folder of your own with modules/ and leds/")
      ->type_name("DIR")
      ->expected(1)
      ->take_all();
  add_short_form(app, "-S,--seed", "simulation.seed", options.overrides, "seed of all randomness");
}

void add_run(CLI::App& app, sim::RunRequest& request) {
  auto& run = *app.add_subcommand("run", "run scenarios: single points, sweeps, batches");
  run.add_option("SCENARIO", request.scenarios, "scenario files (TOML)")->required();
  run.add_option("-o,--output", request.output, "result file, or a folder for several scenarios")
      ->type_name("OUT.h5|DIR/");
  add_scenario_options(run, request.options);
  run.add_option("-t,--threads", request.threads, "threads; results do not depend on it")
      ->check(CLI::Range(1, 1024));
  add_short_form(run, "-n,--max-frames", "stop.max_frames", request.options.overrides,
                 "most frames a point");
  add_short_form(run, "-e,--max-frame-errors", "stop.max_frame_errors", request.options.overrides,
                 "lost frames at which a point stops; 0: no such limit");
  run.add_flag("-q,--quiet", request.quiet, "no progress on stderr");
  run.add_flag("--json", request.json, "one JSON object on stdout instead of the table");
}

void add_trace(CLI::App& app, sim::TraceRequest& request) {
  auto& trace = *app.add_subcommand("trace", "re-run one trial with every tap of the receiver");
  trace.add_option("SCENARIO", request.scenario, "scenario file (TOML)")->required();
  trace.add_option("--point", request.point, "point of the sweep, from 0");
  trace.add_option("--trial", request.trial, "trial, from 0");
  trace.add_option("-o,--output", request.output, "file: .vcd or .csv")->required();
  add_scenario_options(trace, request.options);
}

void add_encode(CLI::App& app, std::string& message) {
  auto& encode = *app.add_subcommand("encode", "the bytes of a device message on the line");
  encode.add_option("MESSAGE", message, "such as 'IND 011111 OK'")->required();
  encode
      .add_option_function<std::string>(
          "--protocol", [](const std::string&) {}, "only cosys")
      ->check(CLI::IsMember({"cosys"}));
}

void add_decode(CLI::App& app, sim::DecodeRequest& request) {
  auto& decode = *app.add_subcommand("decode", "a logic capture to frames and reasons");
  decode.add_option("CAPTURE", request.capture, "capture of the receiver's output (.vcd)")
      ->required();
  decode.add_option("--wire", request.wire, "its name; default rx, else the first");
  decode.add_option("--uart", request.uart, "receiver")
      ->check(CLI::IsMember({"mid-bit", "atmega"}));
  decode.add_option("--baud", request.baud, "rate")->check(CLI::Range(1.0, 1e6));
  decode
      .add_option_function<std::string>(
          "--protocol", [](const std::string&) {}, "only cosys")
      ->check(CLI::IsMember({"cosys"}));
  decode.add_flag("--json", request.json, "one JSON object a line");
}

int parse_and_run(int argc, char** argv) {
  const sim::ProgramInfo program{"cosys-sim", COSYS_VERSION, COSYS_COMMIT};
  CLI::App app{"Bit-level physical-layer simulator of 59 kHz infrared links"};
  app.set_version_flag("--version",
                       program.name + " " + program.version + " (" + program.commit + ")");
  app.require_subcommand(1);
  sim::RunRequest run;
  run.command = command_line(argc, argv);
  run.program = program;
  sim::TraceRequest trace;
  sim::DecodeRequest decode;
  std::string message;
  add_run(app, run);
  add_trace(app, trace);
  add_encode(app, message);
  add_decode(app, decode);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : static_cast<int>(sim::ExitCode::bad_input);
  }
  run.options.parts.push_back(shipped_parts());
  trace.options.parts.push_back(shipped_parts());
  if (app.got_subcommand("run")) return static_cast<int>(sim::run_command(run));
  if (app.got_subcommand("trace")) return static_cast<int>(sim::trace_command(trace));
  if (app.got_subcommand("encode")) return static_cast<int>(sim::encode_command(message));
  return static_cast<int>(sim::decode_command(decode));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return parse_and_run(argc, argv);
  } catch (const sim::Failure& e) {
    std::cerr << "cosys-sim: " << e.what() << "\n";
    return static_cast<int>(e.code());
  } catch (const std::exception& e) {
    std::cerr << "cosys-sim: " << e.what() << " (the machine refused) free memory or disk\n";
    return static_cast<int>(sim::ExitCode::environment);
  }
}
