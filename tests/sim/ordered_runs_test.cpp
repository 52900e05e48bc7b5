// Runs that are shared out to threads and to the members of a process group: each member does some,
// and all have the same sum.
#include "sim/engine/ordered_runs.hpp"

#include <barrier>
#include <mutex>
#include <numeric>
#include <thread>

#include "gtest/gtest.h"

namespace sim {
namespace {

/// What the members share: a place for each one's word.
class Meeting {
 public:
  explicit Meeting(int members) : barrier_(members), words_(static_cast<std::size_t>(members)) {}

  std::vector<std::string> exchange(int rank, std::string mine) {
    words_[static_cast<std::size_t>(rank)] = std::move(mine);
    barrier_.arrive_and_wait();
    std::vector<std::string> all = words_;
    barrier_.arrive_and_wait();
    return all;
  }
  int size() const { return static_cast<int>(words_.size()); }

 private:
  std::barrier<> barrier_;
  std::vector<std::string> words_;
};

/// A process group whose members are threads.
class ThreadMember : public ProcessGroup {
 public:
  ThreadMember(Meeting& meeting, int rank) : meeting_(meeting), rank_(rank) {}

  int size() const override { return meeting_.size(); }
  int rank() const override { return rank_; }
  std::vector<std::string> exchange(const std::string& mine) override {
    return meeting_.exchange(rank_, mine);
  }
  bool any(bool mine) override { return largest(mine ? 1 : 0) > 0; }
  void end_in_order() override { meeting_.exchange(rank_, ""); }
  double largest(double mine) override {
    double all = mine;
    for (const std::string& bytes : meeting_.exchange(rank_, bytes_of(mine)))
      all = std::max(all, from_bytes<double>(bytes));
    return all;
  }

 private:
  Meeting& meeting_;
  int rank_;
};

using RunNumbers = std::vector<std::uint32_t>;

/// What a member of a group did, and what it has in the end.
struct Member {
  RunNumbers done, sum;
};

/// Spans of five runs, the last of a batch maybe fewer, until `enough` runs are counted.
Member count_as(ProcessGroup* processes, const SharedRuns& shared, std::size_t enough) {
  Member member;
  std::mutex mutex;
  OrderedRuns<RunNumbers> runs(shared, [&](std::uint32_t first, int n, const std::atomic<bool>*) {
    std::vector<RunSpan<RunNumbers>> spans;
    for (std::uint32_t at = 0; at < static_cast<std::uint32_t>(n); at += 5) {
      RunSpan<RunNumbers> span{std::min(5U, static_cast<std::uint32_t>(n) - at), {}};
      span.tally.resize(span.n);
      std::iota(span.tally.begin(), span.tally.end(), first + at);
      spans.push_back(std::move(span));
    }
    const std::scoped_lock lock(mutex);
    for (const auto& span : spans)
      member.done.insert(member.done.end(), span.tally.begin(), span.tally.end());
    return spans;
  });
  runs.add_to(
      [&](const RunSpan<RunNumbers>& span) {
        member.sum.insert(member.sum.end(), span.tally.begin(), span.tally.end());
        return member.sum.size() < enough;
      },
      processes, [] {});
  return member;
}

std::vector<Member> count_in_group(int members, const SharedRuns& shared, std::size_t enough) {
  Meeting meeting(members);
  std::vector<Member> all(static_cast<std::size_t>(members));
  {
    std::vector<std::jthread> threads;
    for (int rank = 0; rank < members; ++rank)
      threads.emplace_back([&, rank] {
        ThreadMember member(meeting, rank);
        all[static_cast<std::size_t>(rank)] = count_as(&member, shared, enough);
      });
  }
  return all;
}

RunNumbers numbers(std::uint32_t first, std::size_t n) {
  RunNumbers all(n);
  std::iota(all.begin(), all.end(), first);
  return all;
}

TEST(OrderedRuns, OfAllMembersAreTheSameAndInOrder) {
  for (const std::uint32_t n : {0U, 1U, 9U, 1000U, 12345U})
    for (const int members : {1, 2, 5}) {
      const SharedRuns shared{.runs = n, .most_at_once = 10, .workers = {2}, .first = 3};
      for (const Member& member : count_in_group(members, shared, n + 1))
        EXPECT_EQ(member.sum, numbers(3, n)) << n << " by " << members;
    }
}

TEST(OrderedRuns, EachMemberDoesItsShareAndNoRunIsDoneTwice) {
  const SharedRuns shared{.runs = 4000, .most_at_once = 10, .workers = {1}};
  RunNumbers done;
  for (const Member& member : count_in_group(4, shared, 4001)) {
    EXPECT_GT(member.done.size(), 500U);
    done.insert(done.end(), member.done.begin(), member.done.end());
  }
  std::ranges::sort(done);
  EXPECT_EQ(done, numbers(0, 4000));
}

TEST(OrderedRuns, EndWhereNoMoreAreWanted) {
  const SharedRuns shared{.runs = 1'000'000, .most_at_once = 10, .workers = {2}};
  EXPECT_EQ(count_as(nullptr, shared, 32).sum, numbers(0, 35));
  for (const int members : {1, 3})
    for (const Member& member : count_in_group(members, shared, 32))
      EXPECT_EQ(member.sum, numbers(0, 35)) << members;
}

TEST(OrderedRuns, AreSharedOutInWholeGroups) {
  const SharedRuns shared{
      .runs = 1003, .most_at_once = 40, .workers = {1}, .least_at_once = 5, .group = 5};
  for (const Member& member : count_in_group(3, shared, 2000)) {
    EXPECT_EQ(member.sum, numbers(0, 1003));
    for (std::size_t i = 0; i + 5 < member.done.size(); i += 5)
      EXPECT_EQ(member.done[i] % 5, 0U) << i;
  }
}

}  // namespace
}  // namespace sim
