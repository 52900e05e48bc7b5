#pragma once
// Threads that share one piece of work.
#include <functional>
#include <thread>
#include <vector>

namespace sim {

/// As many threads as asked for, or if 0 one per processor that this process may run on.
int threads_for(int asked);

/// Starts threads that all do `work`. Where the machine does not give as many, those that it gave
/// are ended by `give_up`, and Failure(environment) is thrown.
std::vector<std::jthread> start_threads(int threads, const std::function<void()>& work,
                                        const std::function<void()>& give_up);

}  // namespace sim
