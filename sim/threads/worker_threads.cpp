#include "sim/threads/worker_threads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "sim/failure.hpp"

namespace sim {

int threads_for(int asked) {
  if (asked > 0) return asked;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

std::vector<std::jthread> start_threads(int threads, const std::function<void()>& work,
                                        const std::function<void()>& give_up) {
  std::vector<std::jthread> started;
  try {
    for (int i = 0; i < threads; ++i) started.emplace_back(work);
  } catch (const std::system_error& error) {
    give_up();
    throw Failure(ExitCode::environment,
                  fmt::format("cannot start {} threads ({}) use fewer --threads", threads,
                              error.code().message()));
  }
  return started;
}

}  // namespace sim
