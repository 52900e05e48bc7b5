#pragma once
// bench_sketch.ino, built into the program: the sketch but for its first lines and its steps, of
// which a row each takes the place of the line "// STEPS".
#include <string_view>

namespace sim {

extern const std::string_view sketch_program;

}  // namespace sim
