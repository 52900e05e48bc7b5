#pragma once
// A report for print: a few A4 pages with the answer, pictures, numbers, and what was simulated.
#include <string>
#include <vector>

#include "sim/page/page.hpp"

namespace sim {

/// One to four drawings as large as A4, at 96 pixels to an inch. What has no room there is named.
std::vector<std::string> paper_pages(const Page& page);

}  // namespace sim
