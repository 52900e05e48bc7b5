#pragma once
// What an experiment says of its points.
#include <string>
#include <vector>

#include "sim/columns/column.hpp"
#include "sim/counting/shard.hpp"
#include "sim/picture/chart.hpp"
#include "sim/result/dataset.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/threads/parallel_runs.hpp"

namespace sim {

/// All points of a sweep, with what there is to know of their run.
template <class Point>
struct SweptPoints {
  const LoadedScenario& scenario;
  const std::string& command;
  const std::vector<Shard>& shards;
  const std::vector<Point>& points;
  Workers workers{};  // for what is worked out besides
};

template <class Point>
struct PointReport {
  const Columns<Point>& (*columns)();

  // ---- besides; null: nothing ----

  /// What more there is to say of a single point.
  std::string (*details)(const LoadedScenario&, const Point&) = nullptr;
  /// Puts into a dataset what the columns do not say.
  void (*complete)(Dataset&, const std::vector<Point>&) = nullptr;
  /// Of the current point, behind its number of runs: ", 3 lost".
  std::string (*progress)(const Point&) = nullptr;
  /// Of the points that are done, the first so many: what is known so far.
  std::string (*so_far)(const std::vector<Point>&, std::size_t done) = nullptr;
  /// Where the time of the runs went.
  std::string (*profile)(const std::vector<Point>&) = nullptr;

  // ---- in place of what is made of the columns; null: that ----

  std::string (*json)(const SweptPoints<Point>&, const Dataset&) = nullptr;
  std::vector<Chart> (*charts)(const SweptPoints<Point>&) = nullptr;
  /// Below the table.
  std::string (*notes)(const SweptPoints<Point>&) = nullptr;
};

}  // namespace sim
