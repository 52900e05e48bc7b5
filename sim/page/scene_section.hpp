#pragma once
// The scene of a link, drawn from its scenario: LED and receiver above the floor, how far apart,
// and what else shines. A side view that is not to scale: 10 mm beside metres would not be seen.
#include <optional>
#include <vector>

#include "sim/scenario/settings.hpp"
#include "sim/section/page_section.hpp"

namespace sim {

/// Of links that are given an Eb/N0 nothing: no geometry counts there.
std::optional<PageSection> scene_section(const std::vector<Setting>& settings);

}  // namespace sim
