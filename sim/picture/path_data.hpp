#pragma once
// What the "d" of an SVG path draws, as lines from point to point.
#include <string>
#include <string_view>
#include <vector>

#include "sim/picture/svg.hpp"

namespace sim {

using Polyline = std::vector<SvgPoint>;  // at least two points

/// What draws it.
std::string path_through(const Polyline& corners);

/// Its parts in order, in pixels: M, L, H, V, Z and A of SVG 1.1 (8.3), and the same in small
/// letters. Arcs become lines that are a fiftieth of a pixel off at most. Throws std::logic_error
/// at anything else.
std::vector<Polyline> polylines_of(std::string_view data);

}  // namespace sim
