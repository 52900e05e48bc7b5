#include "sim/command/gnuplot.hpp"

#include <fmt/format.h>
#include <sys/wait.h>

#include "sim/check/child_process.hpp"
#include "sim/check/decoder.hpp"
#include "sim/failure.hpp"
#include "sim/picture/image_provenance.hpp"
#include "sim/threads/stop_signals.hpp"

namespace sim {
namespace {

constexpr const char* gnuplot_command = "exec gnuplot -d -";  // without the user's own settings
constexpr std::chrono::seconds patience{60};

struct Answer {
  Waited waited;
  std::string bytes;
  std::string fault;  // why there is nothing; empty if all went well
};

std::string fault_of(Waited waited, const ChildProcess& gnuplot) {
  if (waited == Waited::timeout) return fmt::format("no answer within {} s", patience.count());
  if (waited == Waited::too_much) return "more than 64 MiB of output";
  const int status = gnuplot.status();
  if (waited != Waited::ended || status == 0) return "";
  const bool is_missing = WIFEXITED(status) && WEXITSTATUS(status) == 127 &&
                          gnuplot.words().find("not found") != std::string::npos;
  return is_missing ? "it is not installed" : last_line_of(gnuplot.words());
}

Answer answer_to(const std::string& script) {
  const std::atomic<bool>& stop = heed_stop_signals();
  ChildProcess gnuplot(gnuplot_command);
  Answer answer{};
  answer.waited = gnuplot.run({.input = script, .timeout = patience, .stop = &stop}, answer.bytes);
  answer.fault = fault_of(answer.waited, gnuplot);
  return answer;
}

}  // namespace

void require_gnuplot(PaperFormat format) {
  const std::string terminal = terminal_name(format);
  std::string fault = answer_to("set terminal " + terminal + "\n").fault;
  if (fault.empty()) return;
  if (fault.find("unknown or ambiguous terminal") != std::string::npos)
    fault = "it has no terminal " + terminal;
  throw Failure(ExitCode::environment,
                fmt::format("--{} needs gnuplot ({}) install gnuplot-nox, or use --svg",
                            format == PaperFormat::png ? "png" : "pdf", fault));
}

std::optional<std::string> drawn_by_gnuplot(const std::vector<std::string>& drawings,
                                            PaperFormat format) {
  Answer answer = answer_to(gnuplot_script(drawings, format));
  if (answer.waited == Waited::stopped) return std::nullopt;
  std::optional<std::string> file = marked_as_own(std::move(answer.bytes), format);
  if (answer.fault.empty() && file) return file;
  throw Failure(ExitCode::environment,
                fmt::format("gnuplot drew no picture ({}) use --svg",
                            answer.fault.empty() ? "it wrote another thing" : answer.fault));
}

}  // namespace sim
