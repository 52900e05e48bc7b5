#pragma once
// The key that a user names, with help for names that are near one.
#include <string>
#include <string_view>

#include "sim/scenario/key.hpp"

namespace sim {

/// Throws bad_input for a name of no key, with the nearest one; `place` says where it is written:
/// "in x.toml:3".
const Key& scenario_key(const std::string& name, const std::string& place);

/// The same where the value says the unit, so that the name may leave it out: "receiver.range" of
/// "3m" is receiver.range_m.
const Key& scenario_key(const std::string& name, std::string_view value, const std::string& place);

}  // namespace sim
