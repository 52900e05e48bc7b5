#include "sim/command/command_line.hpp"

#include <algorithm>
#include <filesystem>

#include "sim/command/command_options.hpp"
#include "sim/command/commands_added.hpp"
#include "sim/command/help_text.hpp"
#include "sim/command/read_usage.hpp"
#include "sim/engine/process_group.hpp"
#include "sim/text/spelling.hpp"
#include "sim/text/standard_output.hpp"

namespace sim {
namespace {

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

/// --help, --help-all, --version.
void print_asked_for(CLI::App& app, const CLI::ParseError& asked_for) {
  const bool is_all = dynamic_cast<const CLI::CallForAllHelp*>(&asked_for) != nullptr;
  const bool is_help = is_all || dynamic_cast<const CLI::CallForHelp*>(&asked_for) != nullptr;
  if (!is_help) return print(std::string(asked_for.what()) + "\n");
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  const std::string command = chosen.empty() ? "" : chosen.front()->get_name();
  print(help_text(usage_of(app), command, is_all));
}

/// Each command has --help-all.
void add_whole_helps(CLI::App& app) {
  for (CLI::App* command : app.get_subcommands(nullptr))
    command->set_help_all_flag("--help-all", "this help, with options that are rarely needed");
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
  FitRequest fit;
  MergeRequest merge;
  ReportRequest report;
  DiffRequest diff;
  CheckRequest check;
  BaselineRequest baseline;
  CompareRequest compare;
  CompletionRequest completion;
  ManualRequest manual;
};

void fill_in(Requests& to, const Surroundings& from) {
  to.run.command = to.find.command = to.merge.command = to.baseline.command = from.command;
  to.run.program = to.trace.program = to.find.program = to.merge.program = to.baseline.program =
      to.check.program = to.manual.program = from.program;
  to.manual.date = from.commit_date;
  for (PartRoots* parts :
       {&to.run.options.parts, &to.trace.options.parts, &to.find.options.parts, &to.parts.parts,
        &to.fit.parts, &to.locate.options.parts, &to.serve.options.parts, &to.check.options.parts,
        &to.baseline.options.parts, &to.compare.options.parts, &to.completion.parts})
    parts->push_back(from.shipped_parts);
}

/// All commands but run would do the same in each process of a job, and write the same file.
bool is_alone() {
  const std::unique_ptr<ProcessGroup> team = join_process_group();
  return collective(team.get(), [&] {
    if (team != nullptr && team->size() > 1)
      throw bad_input("a job of several processes", "only cosys-sim run can share its work out",
                      "start this command without mpirun");
  });
}

ExitCode carry_out(CLI::App& app, const Requests& requests) {
  if (app.got_subcommand("run")) return run_command(requests.run);
  if (!is_alone()) return ExitCode::done;
  if (app.got_subcommand("trace")) return trace_command(requests.trace);
  if (app.got_subcommand("encode")) return encode_command(requests.encode);
  if (app.got_subcommand("node")) return node_command(requests.node);
  if (app.got_subcommand("serve")) return serve_command(requests.serve);
  if (app.got_subcommand("parts")) return parts_command(requests.parts);
  if (app.got_subcommand("find")) return find_command(requests.find);
  if (app.got_subcommand("locate")) return locate_command(requests.locate);
  if (app.got_subcommand("fit")) return fit_command(requests.fit);
  if (app.got_subcommand("merge")) return merge_command(requests.merge);
  if (app.got_subcommand("report")) return report_command(requests.report);
  if (app.got_subcommand("check")) return check_command(requests.check);
  if (app.got_subcommand("baseline")) return baseline_command(requests.baseline);
  if (app.got_subcommand("compare")) return compare_command(requests.compare);
  if (app.got_subcommand("diff")) return diff_command(requests.diff);
  if (app.got_subcommand("completion"))
    return completion_command(requests.completion, usage_of(app));
  if (app.got_subcommand("manual")) return manual_command(requests.manual, usage_of(app));
  return decode_command(requests.decode);
}

/// CLI11 takes a word in brackets for a list. One that names a file or folder is that.
void keep_names_in_brackets(std::vector<std::string>& words) {
  for (std::string& word : words) {
    std::error_code ignored;
    if (word.starts_with('[') && word.ends_with(']') && std::filesystem::exists(word, ignored))
      word.insert(0, "./");
  }
}

void refuse_no_command(const CLI::App& app, const std::string& word) {
  const std::vector<std::string> commands = names_of(app.get_subcommands({}));
  if (std::ranges::find(commands, word) == commands.end()) throw not_known(app, word);
}

/// "help" and "help run" stand for "--help" and "run --help". Last word first, as CLI11 takes them.
std::vector<std::string> words_of(const CLI::App& app, int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  const bool is_help = !words.empty() && words.front() == "help";
  if (is_help) words.erase(words.begin());
  if (!words.empty() && !words.front().starts_with('-')) refuse_no_command(app, words.front());
  if (is_help) words.emplace_back("--help");
  keep_names_in_brackets(words);
  std::ranges::reverse(words);
  return words;
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
  add_fit(app, requests.fit);
  add_merge(app, requests.merge);
  add_report(app, requests.report);
  add_diff(app, requests.diff);
  add_baseline(app, requests.baseline);
  add_check(app, requests.check);
  add_compare(app, requests.compare);
  add_completion(app, requests.completion);
  add_manual(app);
  add_whole_helps(app);
  try {
    app.parse(words_of(app, argc, argv));
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() != 0) throw wrong_usage(app, e);
    print_asked_for(app, e);
    return 0;
  }
  fill_in(requests, surroundings);
  requests.locate.given = given_options(*app.get_subcommand("locate"));
  requests.fit.given = given_options(*app.get_subcommand("fit"));
  return static_cast<int>(carry_out(app, requests));
}

}  // namespace sim
