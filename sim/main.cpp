// The program: what it knows of itself, and one call. Whatever goes wrong below is caught here,
// once, and said in one line.
#include <fcntl.h>
#include <unistd.h>

#include <exception>
#include <filesystem>
#include <new>
#include <string>

#include "sim/command/command_line.hpp"
#include "sim/failure.hpp"
#include "sim/text/shell_text.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/threads/stop_signals.hpp"

namespace {

namespace fs = std::filesystem;

/// The program's own parts, in the build tree as where it is installed.
fs::path shipped_parts() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return program.parent_path().parent_path() / "share" / "cosys-sim";
}

std::string typed_command(int argc, char** argv) {
  std::string text = "cosys-sim";
  for (int i = 1; i < argc; ++i) text += " " + sim::shell_word(argv[i]);
  return text;
}

/// A standard stream that is closed would be the next file opened, and words would end up in it.
void occupy_closed_streams() {
  int descriptor = 0;
  while (descriptor >= 0 && descriptor <= STDERR_FILENO)
    descriptor = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (descriptor > STDERR_FILENO) ::close(descriptor);
}

int fail(const std::string& line, sim::ExitCode code) {
  if (code != sim::ExitCode::reader_gone) sim::say("cosys-sim: " + line + "\n");
  return static_cast<int>(code);
}

}  // namespace

int main(int argc, char** argv) {
  occupy_closed_streams();
  sim::heed_signals();
  try {
    return sim::run_command_line(argc, argv,
                                 {.program = {"cosys-sim", COSYS_VERSION, COSYS_COMMIT},
                                  .commit_date = COSYS_COMMIT_DATE,
                                  .command = typed_command(argc, argv),
                                  .shipped_parts = shipped_parts()});
  } catch (const sim::Failure& e) {
    return fail(e.what(), e.code());
  } catch (const std::bad_alloc&) {
    return fail("out of memory (the machine gave no more) free some or ask for less",
                sim::ExitCode::environment);
  } catch (const std::exception& e) {
    return fail(std::string(e.what()) + " (the machine refused) free memory or disk",
                sim::ExitCode::environment);
  }
}
