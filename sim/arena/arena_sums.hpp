#pragma once
// Counts of messages that reports show and files do not hold, as they follow from those that are
// there: what was sent, and sums over all devices.
#include "sim/result/dataset.hpp"

namespace sim {

/// Adds n_sent of each device (its messages but for those of silent spells), and total_NAME of each
/// point for each count NAME of its devices. Where a file lacks a count its sum is missing too.
void add_message_sums(Dataset& data);

}  // namespace sim
