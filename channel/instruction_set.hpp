#pragma once
// Kernels are built for several instruction sets, equal to the last bit: which of them runs.

namespace channel {

/// The best that this processor has; at most x86-64-v3 (AVX2 and FMA); or the one that every
/// processor has.
enum class InstructionSet { best, v3, baseline };

/// Lanes of the widest kernels, those built for x86-64-v4 (AVX-512), and of the others.
constexpr int most_lanes = 16, narrow_lanes = 8;

/// Whether the kernels built for x86-64-v4 or v3 are to run: they exist, are wanted, and this
/// processor has the set.
bool runs_v4(InstructionSet wanted);
bool runs_v3(InstructionSet wanted);

/// Trials that a kernel computes in the time of one.
int trials_at_once(InstructionSet wanted = InstructionSet::best);

}  // namespace channel
