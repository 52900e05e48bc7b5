#pragma once
// What some runs in a row counted: it is made by a thread, may go to another process, and is added
// to the sum in the order of the runs.
#include <cstdint>

namespace sim {

template <class Tally>
struct RunSpan {
  std::uint32_t n = 0;
  Tally tally{};

  template <class Archive>
  void serialize(Archive& archive) {
    archive(n, tally);
  }
};

}  // namespace sim
