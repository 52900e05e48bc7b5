#include "channel/instruction_set.hpp"

namespace channel {
namespace {

bool has_v3() {
#ifdef COSYS_HAVE_X86
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
         __builtin_cpu_supports("bmi2");
#else
  return false;
#endif
}

bool has_v4() {
#ifdef COSYS_HAVE_X86
  return has_v3() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512vl");
#else
  return false;
#endif
}

}  // namespace

bool runs_v4(InstructionSet wanted) {
  static const bool has = has_v4();
  return wanted == InstructionSet::best && has;
}

bool runs_v3(InstructionSet wanted) {
  static const bool has = has_v3();
  return wanted != InstructionSet::baseline && has;
}

int trials_at_once(InstructionSet wanted) { return runs_v4(wanted) ? most_lanes : narrow_lanes; }

}  // namespace channel
