#pragma once
// The receiver_gate.* files, built into the program. @NAME@ stands for what differs from gate to
// gate.
#include <string_view>

namespace sim {

extern const std::string_view gate_github, gate_gitlab, gate_install;

}  // namespace sim
