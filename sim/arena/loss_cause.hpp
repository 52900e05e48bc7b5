#pragma once
// What becomes of a device's message on its way into a decoder. It is delivered, or lost for
// exactly one cause, so the counts add up.
#include <array>
#include <cstddef>
#include <string_view>

namespace sim {

/// In the order in which they are asked for: the first that fits counts.
enum class LossCause {
  delivered,     // intact
  silent,        // never sent: the device was busy with something else
  out_of_reach,  // in some part of it less light than the module hears
  agc,           // the same module in the same light, without its slow AGC, delivers it
  collision,     // light of another device in reach fell into it
  uart,          // characters were lost or had no stop bit
  checksum       // its line was refused
};
constexpr std::size_t loss_causes = 7;

struct LossCauseName {
  std::string_view name, words;
};
/// In the order of LossCause.
constexpr std::array<LossCauseName, loss_causes> loss_cause_names{{
    {"delivered", "delivered"},
    {"silent", "not sent (silent spell)"},
    {"out_of_reach", "out of reach"},
    {"agc", "slow AGC"},
    {"collision", "collision"},
    {"uart", "UART"},
    {"checksum", "checksum"},
}};

}  // namespace sim
