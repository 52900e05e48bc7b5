#pragma once
// A link as an experiment: its runs are the trials of sim/trial, counted in groups of eight.
#include <functional>
#include <type_traits>

#include "sim/counting/stop_rule.hpp"
#include "sim/engine/checkpoint_bytes.hpp"
#include "sim/engine/measurement.hpp"
#include "sim/link/link.hpp"
#include "sim/result/result.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/threads/parallel_runs.hpp"
#include "sim/trial/trial.hpp"

namespace sim {

struct LinkSetup {
  Link link;
  bool profiled = false;
};

/// What trials counted, and how long all of them took.
struct LinkTally {
  GroupResult sum{};
  double elapsed_s = 0;

  LinkTally& operator+=(const LinkTally& next) {
    sum += next.sum;
    elapsed_s += next.elapsed_s;
    return *this;
  }
  /// As the processor has it: only the same program reads it.
  template <class Archive>
  void serialize(Archive& archive) {
    static_assert(std::is_trivially_copyable_v<GroupResult>);
    archive(cereal::binary_data(&sum, sizeof sum), elapsed_s);
  }
};

extern const Measurement<LinkSetup, LinkTally, LinkPoint> link_measurement;

/// One point by itself, to its stop, without coordinates. `meanwhile` is called from this thread, a
/// few times a second, with what an interrupt would leave. Throws Failure(environment) if the
/// machine does not give as many threads.
LinkPoint run_point(const Link& link, const StopRule& stop, const Workers& workers = {},
                    const std::function<void(const LinkPoint&)>& meanwhile = {});

/// All points of a sweep; fewer if interrupted. For those who need no file and no table.
LinkResult run_link(const LoadedScenario& scenario, const Workers& workers);

/// Operating points, flags and alarms of what is counted: files do not keep them.
void describe_points(const LoadedScenario& scenario, LinkResult& result);

}  // namespace sim
