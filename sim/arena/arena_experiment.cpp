#include "sim/arena/arena_experiment.hpp"

#include <algorithm>
#include <cmath>

#include "channel/instruction_set.hpp"

namespace sim {
namespace {

/// Characters that all devices send in a run, about.
double characters(const Arena& arena) {
  double sum = 0;
  for (const Sender& sender : arena.senders)
    sum += mean_load(sender) * (arena.end / frame_time(sender, 1));
  return sum;
}

std::vector<SenderFacts> facts_of(const Arena& arena) {
  std::vector<SenderFacts> facts;
  for (std::size_t i = 0; i < arena.senders.size(); ++i)
    facts.push_back({arena.senders[i].name, arena.senders[i].kind, arena.light[i].highest()});
  return facts;
}

double share_of_time(const ArenaPoint& point, std::uint64_t airtime_us) {
  return static_cast<double>(airtime_us) * 1e-6 /
         (point.duration_s * static_cast<double>(point.tally.n_runs));
}

}  // namespace

/// As many as there are lanes, but those of all threads, at some 140 bytes a character that devices
/// send, are to take no more than 350 MB.
std::uint32_t arena_runs_at_once(const Arena& arena, int threads) {
  constexpr double most_characters = 2.5e6;
  return static_cast<std::uint32_t>(std::clamp(most_characters / (characters(arena) * threads + 1),
                                               1.0,
                                               static_cast<double>(channel::trials_at_once())));
}

void describe_arena(ArenaPoint& point, const Arena& arena, const ArenaRuns& runs) {
  point.senders = facts_of(arena);
  point.tally = runs.tally;
  point.heard = runs.heard;
  point.duration_s = arena.duration.value;
  point.reach_mw_per_m2 = arena.reach_mw_per_m2;
  point.validity_flags = arena.validity_flags;
}

bool fits_arena(const Arena& arena, const ArenaRuns& runs, std::uint32_t n) {
  const std::size_t senders = arena.senders.size();
  const auto is_sound = [](const SenderTally& tally) { return tally.losses.is_sound(); };
  return runs.tally.n_runs == n && runs.tally.senders.size() == senders &&
         runs.tally.losses.is_sound() && std::ranges::all_of(runs.tally.senders, is_sound) &&
         std::ranges::all_of(runs.heard, [&](const HeardFrame& h) { return h.sender < senders; });
}

Estimate frame_loss(const SenderTally& tally) {
  constexpr double level = 0.95;
  return clustered_ratio(tally.losses, level);
}

Estimate frame_loss(const ArenaRuns& runs, double level) {
  return cautious_ratio(runs.tally.losses, level);
}

SenderTally together(const ArenaPoint& point) {
  SenderTally sum;
  for (const SenderTally& sender : point.tally.senders) sum += sender;
  sum.losses = point.tally.losses;
  return sum;
}

double offered_load(const ArenaPoint& point, const SenderTally& tally) {
  return share_of_time(point, tally.airtime_in_reach_us);
}

double throughput(const ArenaPoint& point, const SenderTally& tally) {
  return share_of_time(point, tally.airtime_delivered_us);
}

double pure_aloha(double load) { return load * std::exp(-2 * load); }

constinit const Measurement<Arena, ArenaRuns, ArenaPoint> arena_measurement{
    .unreached =
        [](const Scenario&, const SourceLocations&, const std::vector<double>& coordinates) {
          return ArenaPoint{.coordinates = coordinates};
        },
    .prepare = [](const Scenario& s, const SourceLocations&,
                  const Workers& w) { return make_arena(s, w); },
    .most_at_once = [](const Arena& arena, std::uint32_t,
                       int threads) { return arena_runs_at_once(arena, threads); },
    .run = run_arena,
    .ratio = [](const Arena&, const ArenaRuns& runs,
                double level) { return frame_loss(runs, level); },
    .describe = describe_arena,
    .fits = fits_arena};

}  // namespace sim
