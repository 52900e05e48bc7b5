#include "sim/engine/process_group.hpp"

#include <algorithm>
#include <exception>
#include <functional>

#include "sim/failure.hpp"
#include "sim/threads/stop_signals.hpp"

namespace sim {

bool collective(ProcessGroup* processes, const std::function<void()>& step) {
  if (processes == nullptr) {
    step();
    return true;
  }
  std::exception_ptr failure;
  try {
    step();
  } catch (...) {
    failure = std::current_exception();
  }
  const int first =
      -static_cast<int>(processes->largest(failure ? -processes->rank() : -processes->size()));
  if (first == processes->size()) return true;
  // The job's starter ends the other members as soon as the first has ended badly.
  if (first != processes->rank()) leave_stop_signals();
  processes->end_in_order();
  if (first == processes->rank()) std::rethrow_exception(failure);
  return false;
}

std::uint64_t next_share(std::uint64_t share, double seconds, std::uint64_t least,
                         std::uint64_t most) {
  constexpr double short_s = 0.25, long_s = 1;
  if (seconds < short_s) return std::min(2 * share, most);
  if (seconds > long_s) return std::max(share / 2, least);
  return share;
}

bool agree(ProcessGroup* processes, const std::string& text) {
  if (processes == nullptr) return true;
  const auto hash = static_cast<double>(std::hash<std::string>{}(text) >> 16U);
  const bool same = processes->largest(hash) == -processes->largest(-hash);
  collective(processes, [&] {
    if (!same)
      throw Failure(ExitCode::environment,
                    "the processes of the job read different files (no folder in common?) put the "
                    "scenario and the result where all of them see it");
  });
  return same;
}

}  // namespace sim
