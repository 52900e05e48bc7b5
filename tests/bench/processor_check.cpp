// The stages are built for x86-64-v3 (CMakeLists.txt). Where the processor lacks it, the program
// ends here: ahead of main and of all other initialisers, as those of the stages are built so too.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

/// ctest's SKIP_RETURN_CODE (CMakeLists.txt), or a failure in the gate.
int skipped() {
  const char* no_skips = std::getenv("COSYS_NO_SKIPS");
  return no_skips != nullptr && std::strcmp(no_skips, "1") == 0 ? 1 : 77;
}

[[gnu::constructor(101)]] void check_processor() {  // 101: before those without a number
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
      __builtin_cpu_supports("bmi2"))
    return;
  std::fputs("bench: this processor lacks AVX2, FMA or BMI2 (the stages are built for them)\n",
             stderr);
  ::_exit(skipped());
}

}  // namespace
