#pragma once
// The columns of a link's result: the terminal's table, HDF5 and JSON are made of them.
#include <vector>

#include "sim/columns/column.hpp"
#include "sim/result/dataset.hpp"
#include "sim/result/result.hpp"

namespace sim {

const Columns<PointResult>& link_columns();

/// Whether a receiver of the sweep is one that theory knows.
bool has_theory(const LoadedScenario& scenario);

/// A dataset of the points' columns has besides: the digest of links, and what its variables and
/// intervals mean.
void complete_link(Dataset& data, const std::vector<PointResult>& points);

/// A link's result as it is written.
Dataset link_dataset(const ExperimentResult& result);

}  // namespace sim
