// Options of baseline, check and compare.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sim/check/decoder.hpp"
#include "sim/command/command_options.hpp"
#include "sim/command/commands_added.hpp"
#include "sim/text/number_text.hpp"

namespace sim {
namespace {

constexpr double most_frames = 1e9;  // of a point

void add_gate_rule(CLI::App& check, SequentialTestRule& rule) {
  check
      .add_option("--worse-than", rule.worse_than,
                  "so many times the loss must not pass; 1.5 if not given")
      ->type_name("X")
      ->check(between(1.01, 100));
  check
      .add_option("--alpha", rule.alpha,
                  "probability of calling a decoder worse that is not, all points together; 0.001 "
                  "if not given")
      ->type_name("P")
      ->check(between(1e-12, 0.1));
  check
      .add_option("--power", rule.power,
                  "probability of not passing one that is so much worse; 0.99 if not given")
      ->type_name("P")
      ->check(between(0.5, 1 - 1e-9));
  check
      .add_option(
          "--negligible", rule.negligible,
          "frame loss ratio below which a decoder passes, whatever the baseline loses; 0.01 "
          "if not given")
      ->type_name("P")
      ->check(between(0, 0.5));
}

std::string decoder_help(const std::string& otherwise) {
  return fmt::format(
      "the decoder: {}, or a command, in which {{vcd}}, {{sr}}, {{edges}}, {{csv}}, {{bytes}}, "
      "{{ook}} or {{wav}} stands for a capture's file; without, it gets edges on stdin; {}",
      fmt::join(built_in_decoders(), ", "), otherwise);
}

void add_program_settings(CLI::App& command, ProgramSettings& settings) {
  command
      .add_option_function<std::string>(
          "--decoder-mode",
          [&settings](const std::string& mode) { settings.serves = mode == "serve"; },
          "a command is run once for each capture, or serves all of them; once if not given")
      ->type_name("once|serve")
      ->check(one_of({"once", "serve"}));
  command
      .add_option_function<std::string>(
          "--decoder-output",
          [&settings](const std::string& output) { settings.prints_frames = output == "frames"; },
          "what a command prints: the bytes that it received, or the messages that it accepted, a "
          "line each; bytes if not given")
      ->type_name("bytes|frames")
      ->check(one_of({"bytes", "frames"}));
  command
      .add_option_function<double>(
          "--decoder-timeout",
          [&settings](double seconds) {
            settings.timeout = std::chrono::duration<double>(seconds);
          },
          "how long a command may take for a capture of 128 frames; 60s if not given")
      ->type_name("TIME")
      ->transform(a_time());
}

void add_decoder(CLI::App& command, std::string& decoder, ProgramSettings& settings,
                 const std::string& otherwise) {
  command.add_option("--decoder", decoder, decoder_help(otherwise))
      ->type_name("NAME|CMD")
      ->check(a_name)
      ->check(likely(built_in_decoders()));
  add_program_settings(command, settings);
}

/// "1.5x" or "1.5".
CLI::Validator a_multiple() {
  return CLI::Validator(
      [](std::string& text) {
        if (text.size() > 1 && text.ends_with('x')) text.pop_back();
        return std::string();
      },
      "");
}

void add_baseline_power(CLI::App& baseline, BaselineRequest& request) {
  baseline
      .add_option("--detect", request.detect,
                  "give each point as many frames as it takes that a check finds a decoder which "
                  "loses so many times as much, and passes an equal one: 1.5x")
      ->type_name("X")
      ->transform(a_multiple())
      ->check(between(1.01, 100));
  baseline
      .add_option("--power", request.power,
                  "how surely it does, and what is said of it; 0.95 if not given")
      ->type_name("P")
      ->check(between(0.5, 1 - 1e-9));
}

}  // namespace

void add_check(CLI::App& app, CheckRequest& request) {
  auto& check = *app.add_subcommand(
      "check",
      "Say whether a decoder is worse than its baseline, frame by frame on the same light");
  add_place(check, "SCENARIO", request.scenarios, "", "scenario files (.toml)")->required();
  add_place(check, "--baseline", request.baseline, "B.h5", "what cosys-sim baseline made of them")
      ->required();
  add_decoder(check, request.decoder, request.program_settings,
              "that of the baseline if not given");
  add_gate_rule(check, request.rule);
  check.add_flag("--golden", request.golden,
                 "fail if one frame comes out otherwise than in the baseline");
  auto* point =
      check
          .add_option("--point", request.point, "only this point of each scenario, counted from 0")
          ->type_name("K")
          ->check(an_index);
  check
      .add_option_function<std::string>(
          "-n,--max-frames",
          [&request](const std::string& text) {
            request.frames = static_cast<std::uint64_t>(*parse_number(text));
          },
          "frames of each point at most; as many as the baseline has if not given")
      ->type_name("N")
      ->check(a_count(most_frames));
  auto* explain = check
                      .add_option("--explain", request.explain,
                                  "in place of the check: a frame as sent, seen, and read")
                      ->type_name("N")
                      ->check(an_index)
                      ->check(between(0, most_frames - 1));
  auto* minimise =
      check
          .add_option(
              "--minimise", request.minimise,
              "in place of the check: the fewest disturbed bits by which only the candidate "
              "loses this frame of a point, as a test vector")
          ->type_name("N")
          ->check(an_index)
          ->check(between(0, most_frames - 1))
          ->excludes(explain);
  check.add_flag("--init", request.init, "in place of the check: write CI workflows that run it")
      ->excludes(explain)
      ->excludes(minimise)
      ->excludes(point);
  add_place(check, "--summary", request.summary, "F.md",
            "page of Markdown for a CI server to show");
  add_place(check, "--junit", request.junit, "F.xml", "JUnit file for a CI server to read");
  add_place(check, "-o,--output", request.output, "FILE",
            "table of points: .csv or .json (JSON lines)");
  add_scenario_options(check, request.options);
  add_threads(check, request.threads);
  check.add_flag("-q,--quiet", request.quiet, "no progress on stderr");
  check.add_flag("--json", request.json, "one JSON object on stdout, not the table");
  check.footer(
      "Exit code 1 if it is worse or fails, 4 if more frames are needed to tell. What decoders "
      "drop: protocol/PROTOCOLS.md. Example: "
      "cosys-sim "
      "check scenarios/quickstart.toml --baseline quickstart-baseline.h5 --decoder soft");
}

void add_baseline(CLI::App& app, BaselineRequest& request) {
  auto& baseline = *app.add_subcommand(
      "baseline", "Write what a decoder makes of each frame of scenarios, to judge others by");
  add_place(baseline, "SCENARIO", request.scenarios, "",
            "scenario files (.toml); if none is given, those that OUT.h5 was made of");
  add_place(baseline, "-o,--output", request.output, "OUT.h5", "baseline to write, or to renew")
      ->required();
  add_decoder(baseline, request.decoder, request.program_settings,
              "if not given, that of OUT.h5, else uart.receiver of the scenario");
  add_scenario_options(baseline, request.options);
  add_threads(baseline, request.threads);
  add_amount(baseline, request.options);
  add_baseline_power(baseline, request);
  baseline.add_flag("-q,--quiet", request.quiet, "no progress on stderr");
  baseline.footer(
      "Each point has as many frames as stop.max_frames says, or more with --detect. Example: "
      "cosys-sim baseline scenarios/quickstart.toml --detect 1.5x -o quickstart-baseline.h5");
}

void add_compare(CLI::App& app, CompareRequest& request) {
  auto& compare = *app.add_subcommand("compare",
                                      "Say which of some decoders loses least of the same light, "
                                      "or accepts most that was not sent");
  add_place(compare, "SCENARIO", request.scenarios, "", "scenario files (.toml)")->required();
  compare
      .add_option("--decoder", request.decoders,
                  decoder_help("give it for each; all that are built in if not given"))
      ->type_name("NAME|CMD")
      ->check(a_name)
      ->check(likely(built_in_decoders()))
      ->take_all()
      ->expected(1);
  add_program_settings(compare, request.program_settings);
  compare
      .add_option("--alpha", request.alpha,
                  "probability of telling two apart that are alike, all points together; 0.001 if "
                  "not given")
      ->type_name("P")
      ->check(between(1e-12, 0.1));
  add_scenario_options(compare, request.options);
  add_threads(compare, request.threads);
  add_amount(compare, request.options);
  compare.add_flag("-q,--quiet", request.quiet, "no progress on stderr");
  compare.add_flag("--json", request.json, "one JSON object on stdout, not the table");
  compare.footer(
      "Each point has as many frames as stop.max_frames says. Of scenarios that listen "
      "(scenarios/false_accepts.toml) it says what each accepts that was not sent, an hour. "
      "Example: "
      "cosys-sim compare scenarios/decoders.toml --decoder atmega --decoder './mine {vcd}'");
}

}  // namespace sim
