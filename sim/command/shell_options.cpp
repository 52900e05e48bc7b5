// Options of completion and manual.
#include "sim/command/command_options.hpp"
#include "sim/command/commands_added.hpp"

namespace sim {

void add_completion(CLI::App& app, CompletionRequest& request) {
  auto& completion = *app.add_subcommand(
      "completion", "Print a script by which a shell completes commands, options and files");
  completion.add_option("SHELL", request.shell, "bash, zsh or fish")
      ->required()
      ->type_name("")
      ->check(one_of({"bash", "zsh", "fish"}));
  completion.footer(
      "bash and fish source it; zsh reads it from a folder of its fpath, as _cosys-sim. Examples: "
      "source <(cosys-sim completion bash); cosys-sim completion fish | source");
}

void add_manual(CLI::App& app) {
  app.add_subcommand("manual", "Print the manual page, with all commands and their options")
      ->footer("Example: cosys-sim manual | man -l -");
}

}  // namespace sim
