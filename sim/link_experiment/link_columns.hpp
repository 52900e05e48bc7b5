#pragma once
// The columns of a link's result: the terminal's table, HDF5 and JSON are made of them.
#include <vector>

#include "sim/columns/column.hpp"
#include "sim/result/dataset.hpp"
#include "sim/result/result.hpp"

namespace sim {

const Columns<LinkPoint>& link_columns();

/// Whether a receiver of the sweep is one that theory knows.
bool has_theory(const LoadedScenario& scenario);

/// Adds what the columns do not say: the digest of links, and attributes that explain intervals,
/// snr_db and ebn0_db.
void complete_link(Dataset& data, const std::vector<LinkPoint>& points);

/// A link's result as it is written.
Dataset link_dataset(const LinkResult& result);

}  // namespace sim
