// Shards: ranges that follow each other, neither overlap nor leave anything out.
#include "sim/counting/shard.hpp"

#include "gtest/gtest.h"

namespace sim {
namespace {

TEST(Shard, IsReadAsUsersWriteIt) {
  EXPECT_EQ(parse_shard("3/16"), (Shard{3, 16}));
  EXPECT_EQ(parse_shard("1/1"), Shard{});
  for (const char* wrong : {"", "3", "/", "3/", "/16", "0/16", "17/16", "3/0", "-1/4", "1/4/4",
                            "1.5/4", " 1/4", "1/100001", "4294967297/4294967298"})
    EXPECT_FALSE(parse_shard(wrong)) << wrong;
}

TEST(Shard, ListsAreReadBack) {
  const std::vector<Shard> shards{{1, 4}, {3, 4}, {15, 16}};
  EXPECT_EQ(shards_text(shards), "1/4 3/4 15/16");
  EXPECT_EQ(parse_shards(shards_text(shards)), shards);
  for (const char* wrong : {"", "1/4 ", "1/4  3/4", "1/4,3/4"})
    EXPECT_FALSE(parse_shards(wrong)) << wrong;
}

TEST(Shard, RangesFollowEachOther) {
  for (const std::uint64_t frames : {1ull, 7ull, 8ull, 100ull, 1001ull, 4000000000ull}) {
    for (const std::uint32_t count : {1u, 2u, 3u, 16u, 1000u, most_shards}) {
      std::uint64_t next = 0;
      for (std::uint32_t k = 1; k <= count; ++k) {
        const TrialRange trials = trials_of({k, count}, frames);
        ASSERT_EQ(trials.first, next);
        ASSERT_TRUE(trials.first % 8 == 0 || trials.first == frames);
        next = trials.last;
      }
      ASSERT_EQ(next, frames);
    }
  }
}

TEST(Shard, RangesAreOfAboutOneSize) {
  for (std::uint32_t k = 1; k <= 7; ++k) {
    const TrialRange trials = trials_of({k, 7}, 1000);
    EXPECT_NEAR(static_cast<double>(trials.last - trials.first), 1000 / 7.0, 8) << k;
  }
}

TEST(Shard, OverlapIsThatOfTheRanges) {
  const std::uint64_t frames = 8 * 5040;  // all counts up to 10 share it evenly
  for (std::uint32_t m = 1; m <= 10; ++m)
    for (std::uint32_t n = 1; n <= 10; ++n)
      for (std::uint32_t i = 1; i <= m; ++i)
        for (std::uint32_t j = 1; j <= n; ++j) {
          const TrialRange a = trials_of({i, m}, frames), b = trials_of({j, n}, frames);
          EXPECT_EQ(overlap({i, m}, {j, n}), a.first < b.last && b.first < a.last);
        }
}

TEST(Shard, AllTogetherOrNot) {
  EXPECT_TRUE(are_all({{1, 1}}));
  EXPECT_TRUE(are_all({{3, 4}, {1, 2}, {4, 4}}));
  EXPECT_FALSE(are_all({{1, 2}, {4, 4}}));
  EXPECT_FALSE(are_all({{2, 2}}));
  EXPECT_FALSE(are_all({{1, 3}, {2, 3}}));
  EXPECT_FALSE(are_all({}));
}

TEST(Shard, SharesAddUpToTheRule) {
  const StopRule rule{.max_frames = 1000, .max_frame_errors = 100};
  std::uint64_t frames = 0, losses = 0;
  for (std::uint32_t k = 1; k <= 16; ++k) {
    frames += share_of(rule, {k, 16}).max_frames;
    losses += share_of(rule, {k, 16}).max_frame_errors;
  }
  EXPECT_EQ(frames, 1000u);
  EXPECT_EQ(losses, 112u);  // 7 each: rounded up
  EXPECT_EQ(share_of({.max_frames = 1000}, {1, 16}).max_frame_errors, 0u);
}

}  // namespace
}  // namespace sim
