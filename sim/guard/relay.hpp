#pragma once
// How a robot tells its base station what it has heard of devices. The robot keeps a table
// of what each device said last, which is its outbound SharedLink list; the base station asks by Q
// for what it lacks.
#include <atomic>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "dsp/philox.hpp"
#include "dsp/units.hpp"
#include "sim/arena/arena_tally.hpp"
#include "sim/guard/guard_keys.hpp"
#include "sim/guard/guard_tally.hpp"
#include "sim/guard/serial_line.hpp"

namespace sim {

struct RelayDesign {
  std::vector<std::string> variables;  // one a device, named by its messages' first word
  GuardSettings settings;
  dsp::Seconds duration;  // of a run
  dsp::Seconds delay;     // from a message's end to its being heard
};

/// Counts of one run but for its arena. `heard`: of this run, by time; its senders are the places
/// of their variables. `draws` and a next purpose are its own. Behind the run the robot goes on
/// until the last message heard has gone over the line; questions and messages of SharedLink are
/// counted while it lasts. Worth nothing once `*stop` is true: it then gives up soon.
GuardTally relay(const RelayDesign& design, std::span<const HeardFrame> heard,
                 const dsp::RandomAddress& draws, const std::atomic<bool>* stop = nullptr);

}  // namespace sim
