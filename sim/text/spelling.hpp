#pragma once
// Which name a user may have meant by another: suggestions for failures.
#include <string>
#include <vector>

namespace sim {

/// The candidate that is spelt most like `name` (case aside), to suggest it; empty if there are
/// none. The part of a candidate behind its dot counts too: "range_m" finds "receiver.range_m".
std::string nearest(const std::string& name, const std::vector<std::string>& candidates);

/// Whether a user may have meant the candidate, or what it is behind its dot: no more than a third
/// of the name is wrong.
bool is_near(const std::string& name, const std::string& candidate);

}  // namespace sim
