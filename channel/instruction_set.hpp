#pragma once
// Kernels are built for several instruction sets, equal to the last bit: which of them runs.

namespace channel {

/// The best that this processor has, or the one that every processor has.
enum class InstructionSet { best, baseline };

/// Whether the kernels built for x86-64-v3 (AVX2 and FMA) are to run: they exist, are wanted, and
/// this processor has the set.
bool runs_v3(InstructionSet wanted);

}  // namespace channel
