#pragma once
// Which of a loop's kernels runs. No kernel includes this.
#include <cassert>
#include <cstddef>

#include "channel/instruction_set.hpp"

namespace channel {

/// A loop as built for each instruction set; those that this build has not are null.
template <class Input>
struct Kernels {
  void (*baseline)(const Input&);
  void (*v3)(const Input&) = nullptr;
  void (*v4)(const Input&) = nullptr;
};

/// Runs the narrowest kernel that has lanes for so many trials: up to trials_at_once(set).
template <class Input>
void run_narrowest(const Kernels<Input>& kernels, const Input& input, std::size_t trials,
                   InstructionSet set) {
  assert(trials <= static_cast<std::size_t>(trials_at_once(set)));
  if (trials > narrow_lanes) return kernels.v4(input);
  if (runs_v3(set)) return kernels.v3(input);
  kernels.baseline(input);
}

}  // namespace channel
