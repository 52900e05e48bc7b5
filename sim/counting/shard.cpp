#include "sim/counting/shard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "channel/chain.hpp"
#include "sim/text/list_text.hpp"

namespace sim {
namespace {

/// A whole number from 1 to `most`.
std::optional<std::uint32_t> parse_count(std::string_view text, std::uint32_t most) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value >= 1 && value <= most ? std::optional(value) : std::nullopt;
}

std::uint64_t product(std::uint32_t a, std::uint32_t b) { return std::uint64_t{a} * b; }

}  // namespace

std::optional<Shard> parse_shard(std::string_view text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) return std::nullopt;
  const auto count = parse_count(text.substr(slash + 1), most_shards);
  if (!count) return std::nullopt;
  const auto number = parse_count(text.substr(0, slash), *count);
  return number ? std::optional(Shard{*number, *count}) : std::nullopt;
}

std::string shards_text(const std::vector<Shard>& shards) {
  std::string text;
  for (const Shard& shard : shards)
    text += fmt::format("{}{}/{}", text.empty() ? "" : " ", shard.number, shard.count);
  return text;
}

std::optional<std::vector<Shard>> parse_shards(std::string_view text) {
  std::vector<Shard> shards;
  for (const std::string_view one : split(text, ' ')) {
    const auto shard = parse_shard(one);
    if (!shard) return std::nullopt;
    shards.push_back(*shard);
  }
  return shards;
}

bool comes_before(const Shard& a, const Shard& b) {
  return product(a.number - 1, b.count) < product(b.number - 1, a.count);
}

bool overlap(const Shard& a, const Shard& b) {
  const auto begins_before_the_end = [](const Shard& one, const Shard& other) {
    return product(one.number - 1, other.count) < product(other.number, one.count);
  };
  return begins_before_the_end(a, b) && begins_before_the_end(b, a);
}

const Shard* overlapping(const std::vector<Shard>& shards, const std::vector<Shard>& more) {
  for (const Shard& shard : more)
    if (std::ranges::any_of(shards, [&](const Shard& s) { return overlap(s, shard); }))
      return &shard;
  return nullptr;
}

bool are_all(std::vector<Shard> shards) {
  std::ranges::sort(shards, comes_before);
  Shard before{0, 1};
  for (const Shard& shard : shards) {
    if (product(shard.number - 1, before.count) != product(before.number, shard.count))
      return false;
    before = shard;
  }
  return before.number == before.count;
}

TrialRange trials_of(const Shard& shard, std::uint64_t max_frames) {
  return runs_of(shard, max_frames, channel::lanes_per_group);
}

TrialRange runs_of(const Shard& shard, std::uint64_t runs, std::uint32_t group) {
  const std::uint64_t groups = (runs + group - 1) / group;
  const auto end_of = [&](std::uint32_t number) {
    return std::min(runs, groups * number / shard.count * group);
  };
  return {end_of(shard.number - 1), end_of(shard.number)};
}

StopRule share_of(const StopRule& rule, const Shard& shard) {
  const TrialRange trials = trials_of(shard, rule.max_frames);
  StopRule share = rule;
  share.max_frames = trials.last - trials.first;
  share.max_frame_errors = (rule.max_frame_errors + shard.count - 1) / shard.count;
  return share;
}

}  // namespace sim
