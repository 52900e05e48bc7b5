#pragma once
// Workers for tests that take long: two threads, which nothing interrupts.
#include "sim/threads/run_sharing.hpp"

namespace sim {

inline constexpr Workers two_threads{.threads = 2, .interrupt = nullptr};

}  // namespace sim
