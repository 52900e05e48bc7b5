#pragma once
// What of a robo-guard's scenario cannot be a SharedLink list.
#include <string>
#include <vector>

#include "sim/arena/sender.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

/// The variables in which a guard keeps what each device said last, named by the first word of its
/// messages. Throws bad_input where messages cannot be such a list: devices whose messages begin
/// alike, characters that it cannot carry.
std::vector<std::string> shared_variables(const std::vector<Sender>& senders);

/// Throws for what is wrong at any point of such a scenario.
void check_guard(const LoadedScenario& scenario);

}  // namespace sim
