#include "sim/command/judging.hpp"

#include <fmt/format.h>

#include "sim/check/decoder.hpp"
#include "sim/failure.hpp"
#include "sim/text/shell_text.hpp"
#include "sim/text/standard_output.hpp"

namespace sim {

std::vector<LoadedScenario> load_links(const std::vector<std::filesystem::path>& scenarios,
                                       const ScenarioOptions& options, const std::string& command) {
  std::vector<LoadedScenario> loaded;
  for (const auto& path : scenarios) loaded.push_back(load_link(options, path, command));
  return loaded;
}

std::string own_decoder(const Baseline& baseline) {
  if (make_built_in_decoder(baseline.decoder) != nullptr) return baseline.decoder;
  throw bad_input("no --decoder", "the baseline's is a program, which no file may start",
                  "say it: --decoder " + shell_word(baseline.decoder));
}

void show_progress(bool quiet, const std::string& command, std::size_t done, std::size_t of) {
  if (!quiet) say(fmt::format("cosys-sim {}: point {} of {} done\n", command, done, of));
}

ExitCode end_interrupted() {
  say("cosys-sim: interrupted (by a signal) nothing was written; the same command begins anew\n");
  return ExitCode::interrupted;
}

}  // namespace sim
