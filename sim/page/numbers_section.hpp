#pragma once
// The table of all points of a link's result, and which of them are marked in it.
#include <string>

#include "sim/result/result.hpp"
#include "sim/section/page_section.hpp"

namespace sim {

/// The columns of `run` with irradiance and SNR, theory where there is one, and marks of what to
/// heed in the last, which are explained.
PageSection numbers_section(const LinkResult& result);

/// A sentence of how many points are marked, as their table is far below; empty of none.
std::string marked_points(const LinkResult& result);

}  // namespace sim
