#include "sim/engine/engine.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <thread>
#include <type_traits>
#include <vector>

#include "sim/engine/batch_sizes.hpp"
#include "sim/engine/checkpoint_bytes.hpp"
#include "sim/engine/ordered_runs.hpp"
#include "sim/threads/stopwatch.hpp"
#include "sim/trial/trial.hpp"

namespace sim {

// The members of a process group run the same program.
static_assert(std::is_trivially_copyable_v<GroupResult>);
static void CEREAL_SAVE_FUNCTION_NAME(CheckpointOutput& archive, const GroupResult& group) {
  archive.save(&group, sizeof group);
}
static void CEREAL_LOAD_FUNCTION_NAME(CheckpointInput& archive, GroupResult& group) {
  archive.load(&group, sizeof group);
}

namespace {

using GroupSpans = OrderedRuns<GroupResult>::Spans;

GroupSpans group_spans(const std::vector<GroupResult>& groups, std::uint32_t trials) {
  GroupSpans spans;
  for (const GroupResult& group : groups)
    spans.push_back(
        {std::min(group_size, trials - group_size * static_cast<std::uint32_t>(spans.size())),
         group});
  return spans;
}

/// The trials of a point that are not counted yet.
SharedRuns trials_left(const Link& link, const StopRule& stop, const EngineOptions& options,
                       std::uint64_t done) {
  const BatchSizes sizes = batch_sizes(link);
  return {.runs = static_cast<std::uint32_t>(stop.max_frames - std::min(done, stop.max_frames)),
          .most_at_once = sizes.most,
          .workers = {.threads = options.threads, .interrupt = options.interrupt},
          .first = static_cast<std::uint32_t>(options.first_trial + done),
          .least_at_once = sizes.least,
          .group = group_size};
}

PointResult as_point(const GroupResult& sum, StopReason stop, const Link& link, double elapsed_s) {
  return {.operating = link.operating,
          .tally = sum.tally,
          .stop = stop,
          .elapsed_s = elapsed_s,
          .simulated_s = sum.simulated_s,
          .n_samples = sum.n_samples,
          .validity_flags = link.validity_flags,
          .profile = sum.profile};
}

}  // namespace

PointResult run_point(const Link& link, const StopRule& stop, const EngineOptions& options,
                      const PointResult& before) {
  const Stopwatch watch;
  const SharedRuns trials = trials_left(link, stop, options, before.tally.n_frames);
  GroupResult sum{before.tally, before.simulated_s, before.n_samples, before.profile};
  std::optional<StopReason> reason;
  if (trials.runs == 0) reason = StopReason::max_frames;
  if (before.tally.n_frames > 0) reason = stop_reason(stop, before.tally);
  if (reason) return as_point(sum, *reason, link, before.elapsed_s);
  const auto point = [&](StopReason why) {
    return as_point(sum, why, link, before.elapsed_s + watch.seconds());
  };
  OrderedRuns<GroupResult> runs(
      trials, [&](std::uint32_t first, int n, const std::atomic<bool>* over) {
        return group_spans(run_groups(link, first, n, over, options.profiled),
                           static_cast<std::uint32_t>(n));
      });
  runs.add_to(
      [&](const RunSpan<GroupResult>& group) {
        sum += group.tally;
        reason = stop_reason(stop, sum.tally);
        return !reason;
      },
      options.processes,
      [&] {
        if (options.on_progress)
          options.on_progress(point(reason.value_or(StopReason::interrupted)));
      });
  return point(reason.value_or(StopReason::interrupted));
}

bool is_resumable(const PointResult& point) { return point.tally.n_frames % group_size == 0; }

int threads_for(int asked) {
  if (asked > 0) return asked;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace sim
