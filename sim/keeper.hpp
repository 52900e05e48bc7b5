#pragma once
// Keeps what is counted while a run goes on, so that no kill loses more than some seconds of it.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <utility>

#include "sim/program_info.hpp"
#include "sim/store.hpp"

namespace sim {

/// Writes a result file, points under way included: at most once a second and a twentieth of the
/// time, but every ten seconds in any case.
class Keeper {
 public:
  Keeper(std::filesystem::path output, ProgramInfo program)
      : output_(std::move(output)), program_(std::move(program)) {}

  bool is_due() const { return Clock::now() >= next_; }

  void keep(const ExperimentResult& result) {
    const auto began = Clock::now();
    write_result(output_, result, program_);
    next_ = Clock::now() + std::clamp<Clock::duration>(20 * (Clock::now() - began),
                                                       std::chrono::seconds(1),
                                                       std::chrono::seconds(10));
  }

 private:
  using Clock = std::chrono::steady_clock;

  std::filesystem::path output_;
  ProgramInfo program_;
  Clock::time_point next_ = Clock::now() + std::chrono::seconds(1);
};

}  // namespace sim
