#include "channel/instruction_set.hpp"

namespace channel {
namespace {

bool has_v3() {
#ifdef COSYS_HAVE_V3
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
         __builtin_cpu_supports("bmi2");
#else
  return false;
#endif
}

}  // namespace

bool runs_v3(InstructionSet wanted) {
  static const bool has = has_v3();
  return wanted == InstructionSet::best && has;
}

}  // namespace channel
