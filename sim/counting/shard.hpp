#pragma once
// Shards: an experiment's trials shared out to machines that do not know of each other. Each runs
// a range of every point's trials into a file of its own, and `cosys-sim merge` adds them up.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/counting/stop_rule.hpp"

namespace sim {

/// One of `count` ranges of about equal size, which follow each other; 1/1 is all trials.
struct Shard {
  std::uint32_t number = 1;  // from 1
  std::uint32_t count = 1;
  friend bool operator==(const Shard&, const Shard&) = default;
};

constexpr std::uint32_t most_shards = 100'000;

/// "3/16" as users write it; nothing if it is no shard.
std::optional<Shard> parse_shard(std::string_view text);

/// "1/4 3/4", the text that parse_shards() reads.
std::string shards_text(const std::vector<Shard>& shards);
std::optional<std::vector<Shard>> parse_shards(std::string_view text);

/// Whether `a` begins before `b`.
bool comes_before(const Shard& a, const Shard& b);

bool overlap(const Shard& a, const Shard& b);

/// The first of `more` that overlaps one of `shards`; null: none does.
const Shard* overlapping(const std::vector<Shard>& shards, const std::vector<Shard>& more);

/// Whether shards that do not overlap are all trials together.
bool are_all(std::vector<Shard> shards);

/// Trials first ... last - 1.
struct TrialRange {
  std::uint64_t first, last;
};

/// The shard's own trials out of max_frames: whole groups of eight, but for the last trials of all.
TrialRange trials_of(const Shard& shard, std::uint64_t max_frames);

/// The same of runs in groups of another size, or one by one.
TrialRange runs_of(const Shard& shard, std::uint64_t runs, std::uint32_t group = 1);

/// When the shard has done its share of a point: its trials, or its share of the lost frames, of
/// which all shards together then have what was asked for. The sum of their frames is distributed
/// as it is when one run waits for all of them: waiting for e losses is waiting for e/N, N times.
StopRule share_of(const StopRule& rule, const Shard& shard);

}  // namespace sim
