#pragma once
// Failure: what the user or the machine did wrong, thrown at the border and caught once in main.
// The message is one line: PROBLEM (WHY) SUGGESTION, with file and line where there is one.
#include <stdexcept>
#include <string>

namespace sim {

enum class ExitCode {
  done = 0,
  check_failed = 1,
  bad_input = 2,
  environment = 3,
  inconclusive = 4,  // done, but the question stays open
  interrupted = 130,
  reader_gone = 141  // as a shell says of SIGPIPE; nobody is told
};

class Failure : public std::runtime_error {
 public:
  /// Control characters of the message become question marks: it is one line, whatever it names.
  Failure(ExitCode code, std::string message);
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// What a bad input is answered with.
Failure bad_input(const std::string& problem, const std::string& why,
                  const std::string& suggestion);

}  // namespace sim
