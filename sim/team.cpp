#include "sim/team.hpp"

#include <cstdint>
#include <functional>
#include <optional>

#include "sim/failure.hpp"

namespace sim {

bool together(Team* team, const std::function<void()>& step) {
  std::optional<Failure> failure;
  try {
    step();
  } catch (const Failure& e) {
    failure = e;
  }
  if (team == nullptr) {
    if (failure) throw *failure;
    return true;
  }
  const int first = -static_cast<int>(team->largest(failure ? -team->rank() : -team->size()));
  if (failure && first == team->rank()) throw *failure;
  return first == team->size();
}

void check_agreement(Team* team, const std::string& text) {
  if (team == nullptr) return;
  const auto hash = static_cast<double>(std::hash<std::string>{}(text) >> 16U);
  const bool same = team->largest(hash) == -team->largest(-hash);
  if (!same && team->rank() == 0)
    throw Failure(ExitCode::environment,
                  "the processes of the job read different files (no folder in common?) put the "
                  "scenario and the result where all of them see it");
}

}  // namespace sim
