#include "sim/command/commands.hpp"
#include "sim/command/completion.hpp"
#include "sim/command/manual_page.hpp"
#include "sim/text/standard_output.hpp"

namespace sim {

ExitCode completion_command(const CompletionRequest& request, const ProgramUsage& usage) {
  print(request.shell == "zsh" ? zsh_completion(usage) : bash_completion(usage));
  return ExitCode::done;
}

ExitCode manual_command(const ManualRequest& request, const ProgramUsage& usage) {
  print(manual_page(usage, request.program.version, request.date));
  return ExitCode::done;
}

}  // namespace sim
