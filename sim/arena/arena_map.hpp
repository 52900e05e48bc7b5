#pragma once
// An arena from above, with what was heard where, for reports.
#include <cstddef>

#include "sim/result/stored_dataset.hpp"
#include "sim/section/page_section.hpp"

namespace sim {

/// Of one point of the sweep: its devices, the receiver's way and each message that was delivered,
/// in the colour of its device's kind, with a table of the devices.
PageSection arena_map(const StoredDataset& stored, std::size_t point);

}  // namespace sim
