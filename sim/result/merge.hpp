#pragma once
// Adds results of the same experiment up: shards, or what several merges made of some.
#include "sim/result/result.hpp"

namespace sim {

/// Adds the counts and costs of `other`, whose points are those of `sum` and whose shards overlap
/// none of its. Points keep no operating points (describe_points). A point that one of the two left
/// unfinished is unfinished.
void add(ExperimentResult& sum, const ExperimentResult& other);

/// The first of `more` that overlaps one of `shards`, if any.
const Shard* overlapping(const std::vector<Shard>& shards, const std::vector<Shard>& more);

}  // namespace sim
