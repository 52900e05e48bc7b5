#include "sim/arena/arena_experiment.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <iterator>
#include <mutex>
#include <optional>
#include <utility>

#include "channel/instruction_set.hpp"
#include "sim/arena/arena_run.hpp"
#include "sim/point_scenario.hpp"
#include "sim/sweep.hpp"
#include "sim/worker_threads.hpp"

namespace sim {
namespace {

/// Characters that all devices send in a run, about.
double characters(const Arena& arena) {
  double sum = 0;
  for (const Sender& sender : arena.senders)
    sum += mean_load(sender) * (arena.end / frame_time(sender, 1));
  return sum;
}

/// Runs that a thread does at once: as many as there are lanes, but not so many that others have
/// none, nor that all of them, at some 140 bytes a character, take more than 350 MB.
std::uint32_t runs_at_once(const Arena& arena, std::uint32_t runs, int threads) {
  constexpr double most_characters = 2.5e6;
  const auto n = static_cast<std::uint32_t>(threads);
  const double fit = most_characters / (characters(arena) * threads + 1);
  const auto lanes = static_cast<double>(channel::trials_at_once());
  const auto most = static_cast<std::uint32_t>(std::clamp(fit, 1.0, lanes));
  return std::clamp((runs + n - 1) / n, 1U, most);
}

/// The runs of one point, shared out to threads by the lot and added up in order.
class RunSharing {
 public:
  RunSharing(const Arena& arena, std::uint32_t runs, const ArenaOptions& options)
      : arena_(arena),
        runs_(runs),
        lot_(runs_at_once(arena, runs, options.threads)),
        stop_(options.interrupt),
        lots_((runs + lot_ - 1) / lot_) {}

  void work() {
    while (const auto lot = next()) {
      try {
        const std::uint32_t first = *lot * lot_;
        ArenaRuns runs =
            run_arena(arena_, first, static_cast<int>(std::min(lot_, runs_ - first)), stop_);
        if (!stopped()) lots_[*lot] = std::move(runs);
      } catch (...) {
        give_up(std::current_exception());
      }
    }
  }

  void give_up(const std::exception_ptr& error = nullptr) {
    const std::scoped_lock lock(mutex_);
    if (!error_) error_ = error;
    next_ = static_cast<std::uint32_t>(lots_.size());
  }

  /// All runs, or after an interrupt those up to the first that was not finished.
  ArenaRuns sum() {
    if (error_) std::rethrow_exception(error_);
    ArenaRuns all;
    for (std::optional<ArenaRuns>& lot : lots_) {
      if (!lot) break;
      all.tally += lot->tally;
      std::ranges::move(lot->heard, std::back_inserter(all.heard));
    }
    return all;
  }

 private:
  bool stopped() const { return stop_ != nullptr && *stop_; }

  std::optional<std::uint32_t> next() {
    const std::scoped_lock lock(mutex_);
    if (next_ >= lots_.size() || stopped()) return std::nullopt;
    return next_++;
  }

  const Arena& arena_;
  std::uint32_t runs_, lot_;
  const std::atomic<bool>* stop_;
  std::vector<std::optional<ArenaRuns>> lots_;
  std::mutex mutex_;
  std::uint32_t next_ = 0;
  std::exception_ptr error_;
};

std::vector<SenderFacts> facts_of(const Arena& arena) {
  std::vector<SenderFacts> facts;
  for (std::size_t i = 0; i < arena.senders.size(); ++i)
    facts.push_back({arena.senders[i].name, arena.senders[i].kind, arena.light[i].highest()});
  return facts;
}

ArenaPoint run_point(const Scenario& scenario, std::vector<double> coordinates,
                     const ArenaOptions& options) {
  const Arena arena = make_arena(scenario);
  ArenaPoint point{.coordinates = std::move(coordinates),
                   .senders = facts_of(arena),
                   .duration_s = arena.duration.value,
                   .reach_mw_per_m2 = arena.reach_mw_per_m2};
  RunSharing sharing(arena, static_cast<std::uint32_t>(scenario.arena.runs), options);
  start_threads(
      options.threads, [&] { sharing.work(); }, [&] { sharing.give_up(); })
      .clear();  // waits for them
  ArenaRuns runs = sharing.sum();
  point.tally = std::move(runs.tally);
  point.heard = std::move(runs.heard);
  point.simulated_s = arena.end.value * static_cast<double>(point.tally.n_runs);
  return point;
}

double share_of_time(const ArenaPoint& point, std::uint64_t airtime_us) {
  return static_cast<double>(airtime_us) * 1e-6 /
         (point.duration_s * static_cast<double>(point.tally.n_runs));
}

}  // namespace

SenderTally together(const ArenaPoint& point) {
  SenderTally sum;
  for (const SenderTally& sender : point.tally.senders) sum += sender;
  return sum;
}

double offered_load(const ArenaPoint& point, const SenderTally& tally) {
  return share_of_time(point, tally.airtime_in_reach_us);
}

double throughput(const ArenaPoint& point, const SenderTally& tally) {
  return share_of_time(point, tally.airtime_delivered_us);
}

double pure_aloha(double load) { return load * std::exp(-2 * load); }

double mean_latency_s(const SenderTally& tally) {
  return static_cast<double>(tally.latency_us) * 1e-6 / static_cast<double>(tally.n_runs_heard);
}

std::vector<ArenaPoint> run_arenas(const LoadedScenario& scenario, const ArenaOptions& options) {
  std::vector<ArenaPoint> points(count_points(scenario.sweep));
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].coordinates = point_coordinates(scenario.sweep, i);
    if (options.interrupt != nullptr && *options.interrupt) continue;
    points[i] =
        run_point(point_scenario(scenario, points[i].coordinates), points[i].coordinates, options);
    if (options.on_point && points[i].tally.n_runs > 0) options.on_point(points[i]);
  }
  return points;
}

}  // namespace sim
