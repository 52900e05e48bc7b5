#include "sim/team_engine.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <mutex>
#include <optional>
#include <vector>

#include "channel/instruction_set.hpp"
#include "sim/team.hpp"
#include "sim/worker_threads.hpp"

namespace sim {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint64_t group_size = channel::lanes_per_group;

// Between waves the members wait for the slowest, so waves are long against that, but not so long
// that a user who interrupts must wait.
constexpr double short_wave_s = 0.25, long_wave_s = 1;
constexpr std::size_t largest_wave = 1 << 15;  // batches of a member

/// Groups that a thread takes at once, in all members alike: as many as the widest processors have
/// lanes for.
constexpr std::uint64_t batch_size = channel::most_lanes / group_size;

/// The batches that one member runs between two exchanges, `stride` groups apart from group `first`
/// on.
struct Wave {
  std::uint64_t first, stride;
  std::size_t batches;
  std::uint64_t end_trial;  // of the point; groups behind it are empty

  std::size_t groups() const { return batches * batch_size; }
  std::uint64_t trial_of(std::size_t i) const { return (first + i * stride) * group_size; }
  int size_of(std::size_t i) const {
    const std::uint64_t left = end_trial - std::min(end_trial, trial_of(i));
    return static_cast<int>(std::min(batch_size * group_size, left));
  }
};

/// Runs a wave on some threads.
class WaveRun {
 public:
  WaveRun(const Link& link, const Wave& wave, const EngineOptions& options)
      : link_(link), wave_(wave), options_(options), results_(wave.groups()) {}

  std::vector<GroupResult> run() {
    start_threads(
        options_.threads, [this] { work(); }, [this] { next_ = wave_.batches; })
        .clear();  // waits for them
    if (failure_) std::rethrow_exception(failure_);
    return std::move(results_);
  }

 private:
  void work() {
    try {
      for (std::size_t i = next_++; i < wave_.batches; i = next_++)
        if (const int n = wave_.size_of(i); n > 0)
          std::ranges::move(run_groups(link_, static_cast<std::uint32_t>(wave_.trial_of(i)), n,
                                       options_.interrupt, options_.profiled),
                            results_.data() + i * batch_size);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      failure_ = std::current_exception();
    }
  }

  const Link& link_;
  const Wave wave_;
  const EngineOptions& options_;
  std::atomic<std::size_t> next_ = 0;
  std::vector<GroupResult> results_;
  std::mutex mutex_;
  std::exception_ptr failure_;
};

/// Adds what all members ran in the order of the trials, up to where the rule stops.
std::optional<StopReason> add_in_order(const std::vector<GroupResult>& all, std::size_t members,
                                       const StopRule& rule, GroupResult& sum) {
  const std::size_t groups = all.size() / members;
  for (std::size_t batch = 0; batch < groups; batch += batch_size) {
    for (std::size_t member = 0; member < members; ++member) {
      for (std::size_t i = batch; i < batch + batch_size; ++i) {
        sum += all[member * groups + i];
        if (const auto reason = stop_reason(rule, sum.tally)) return reason;
      }
    }
  }
  return std::nullopt;
}

std::size_t next_size(std::size_t batches, double seconds) {
  if (seconds < short_wave_s) return std::min(2 * batches, largest_wave);
  return seconds > long_wave_s ? std::max<std::size_t>(batches / 2, 1) : batches;
}

}  // namespace

PointResult run_point_together(const Link& link, const StopRule& stop, const EngineOptions& options,
                               const PointResult& before) {
  Team& team = *options.team;
  const auto began = Clock::now();
  const auto since = [](Clock::time_point then) {
    return std::chrono::duration<double>(Clock::now() - then).count();
  };
  const auto members = static_cast<std::uint64_t>(team.size());
  GroupResult sum{before.tally, before.simulated_s, before.n_samples, before.profile};
  Wave wave{(options.first_trial + sum.tally.n_frames) / group_size +
                static_cast<std::uint64_t>(team.rank()) * batch_size,
            members * batch_size, static_cast<std::size_t>(team.largest(options.threads)),
            options.first_trial + stop.max_frames};
  for (;;) {
    const auto wave_began = Clock::now();
    const auto mine = WaveRun(link, wave, options).run();
    const double seconds = team.largest(since(wave_began));
    if (team.any(options.interrupt != nullptr && *options.interrupt))
      return as_point(sum, StopReason::interrupted, link, before.elapsed_s + since(began));
    const auto reason = add_in_order(team.exchange(mine), members, stop, sum);
    if (reason) return as_point(sum, *reason, link, before.elapsed_s + since(began));
    if (options.on_progress)
      options.on_progress(
          as_point(sum, StopReason::interrupted, link, before.elapsed_s + since(began)));
    wave.first += wave.groups() * members;
    wave.batches = next_size(wave.batches, seconds);
  }
}

}  // namespace sim
