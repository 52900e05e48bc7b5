#include "sim/engine/process_group.hpp"

#include <algorithm>
#include <exception>
#include <functional>

#include "sim/failure.hpp"
#include "sim/threads/stop_signals.hpp"

namespace sim {

bool collective(ProcessGroup* team, const std::function<void()>& step) {
  if (team == nullptr) {
    step();
    return true;
  }
  std::exception_ptr failure;
  try {
    step();
  } catch (...) {
    failure = std::current_exception();
  }
  const int first = -static_cast<int>(team->largest(failure ? -team->rank() : -team->size()));
  if (first == team->size()) return true;
  // The job's starter ends the other members as soon as the first has ended badly.
  if (first != team->rank()) leave_stop_signals();
  team->end_in_order();
  if (first == team->rank()) std::rethrow_exception(failure);
  return false;
}

std::uint64_t next_share(std::uint64_t share, double seconds, std::uint64_t least,
                         std::uint64_t most) {
  constexpr double short_s = 0.25, long_s = 1;
  if (seconds < short_s) return std::min(2 * share, most);
  if (seconds > long_s) return std::max(share / 2, least);
  return share;
}

bool agree(ProcessGroup* team, const std::string& text) {
  if (team == nullptr) return true;
  const auto hash = static_cast<double>(std::hash<std::string>{}(text) >> 16U);
  const bool same = team->largest(hash) == -team->largest(-hash);
  collective(team, [&] {
    if (!same)
      throw Failure(ExitCode::environment,
                    "the processes of the job read different files (no folder in common?) put the "
                    "scenario and the result where all of them see it");
  });
  return same;
}

}  // namespace sim
