#pragma once
// Workers for tests of what must not hang on their number.
#include "sim/threads/run_sharing.hpp"

namespace sim {

inline constexpr Workers two_threads{.threads = 2, .interrupt = nullptr};

}  // namespace sim
