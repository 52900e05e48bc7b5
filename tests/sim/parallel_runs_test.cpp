#include "sim/threads/parallel_runs.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>
#include <thread>

namespace sim {
namespace {

using RunNumbers = std::vector<std::uint32_t>;

using Over = const std::atomic<bool>*;

RunNumbers numbers(std::uint32_t first, int n) {
  RunNumbers of_batch(static_cast<std::size_t>(n));
  std::iota(of_batch.begin(), of_batch.end(), first);
  return of_batch;
}

RunNumbers numbers_of_batch(std::uint32_t first, int n, Over) { return numbers(first, n); }
int size_of_batch(std::uint32_t, int n, Over) { return n; }

RunNumbers joined(const std::vector<RunNumbers>& batches) {
  RunNumbers all;
  for (const RunNumbers& batch : batches) all.insert(all.end(), batch.begin(), batch.end());
  return all;
}

TEST(ParallelRuns, GivesEveryRunOnceInOrderHoweverManyThreadsThereAre) {
  for (const std::uint32_t runs : {0U, 1U, 7U, 100U})
    for (const int threads : {1, 2, 16}) {
      ParallelRuns<RunNumbers> parallel({runs, 5, {threads}}, numbers_of_batch);
      EXPECT_EQ(joined(parallel()), numbers(0, static_cast<int>(runs)));
    }
}

TEST(ParallelRuns, DoesNoMoreAtOnceThanAllowedAndLeavesNoThreadWithout) {
  ParallelRuns<int> many({100, 3, {1}}, size_of_batch);
  const std::vector<int> of_three = many();
  EXPECT_LE(std::ranges::max(of_three), 3);
  ParallelRuns<int> few({4, 100, {4}}, size_of_batch);
  EXPECT_EQ(few(), (std::vector{1, 1, 1, 1}));
}

TEST(ParallelRuns, KeepsWhatWasFinishedBeforeAStop) {
  std::atomic<bool> stop = false;
  ParallelRuns<RunNumbers> parallel({100, 1, {1, &stop}}, [&](std::uint32_t first, int n, Over) {
    if (first == 4) stop = true;
    return numbers(first, n);
  });
  EXPECT_EQ(joined(parallel()),
            (RunNumbers{0, 1, 2, 3}));  // of the fifth nobody knows how far it came
}

TEST(ParallelRuns, LeavesNoGapWhereALaterBatchWasFinishedFirst) {
  std::atomic<bool> stop = false;
  ParallelRuns<RunNumbers> parallel({3, 1, {2, &stop}}, [&](std::uint32_t first, int n, Over) {
    while (first == 0 && !stop) std::this_thread::yield();  // while another thread does the second
    if (first == 2) stop = true;
    return numbers(first, n);
  });
  EXPECT_TRUE(parallel().empty());
}

// Whoever takes them needs no lock, and has the first before the last is done.
TEST(ParallelRuns, GivesBatchesInOrderWhileOthersGoOn) {
  std::atomic<bool> first_taken = false;
  ParallelRuns<RunNumbers> parallel({.runs = 20, .most_at_once = 2, .workers = {3}, .first = 7},
                                    [&](std::uint32_t first, int n, Over) {
                                      while (first > 20 && !first_taken) std::this_thread::yield();
                                      return numbers(first, n);
                                    });
  RunNumbers all;
  std::uint32_t runs = 0;
  std::atomic<int> inside = 0;
  parallel.in_order(
      [&](RunNumbers&& batch, std::uint32_t n) {
        EXPECT_EQ(++inside, 1);
        EXPECT_EQ(batch.size(), n);
        all.insert(all.end(), batch.begin(), batch.end());
        runs += n;
        first_taken = true;
        --inside;
        return true;
      },
      [&] {
        EXPECT_EQ(++inside, 1);
        --inside;
      });
  EXPECT_EQ(all, numbers(7, 20));
  EXPECT_EQ(runs, 20U);
}

TEST(ParallelRuns, GivesNoMoreThanAreWantedAndTellsTheOthers) {
  for (const int threads : {1, 2, 5}) {
    RunNumbers all;
    ParallelRuns<RunNumbers> parallel(
        {.runs = 4'000'000'000, .most_at_once = 3, .workers = {threads}},
        [&](std::uint32_t first, int n, Over over) {
          while (first >= 30 && !*over) std::this_thread::yield();
          return numbers(first, n);
        });
    parallel.in_order([&](RunNumbers&& batch, std::uint32_t) {
      all.insert(all.end(), batch.begin(), batch.end());
      return all.size() < 30;
    });
    EXPECT_EQ(all, numbers(0, 30)) << threads;
  }
}

TEST(ParallelRuns, BeginsAndEndsWithSmallBatches) {
  ParallelRuns<int> parallel(
      {.runs = 1002, .most_at_once = 64, .workers = {2}, .least_at_once = 16, .group = 8},
      size_of_batch);
  const std::vector<int> sizes = parallel();
  EXPECT_EQ(std::accumulate(sizes.begin(), sizes.end(), 0), 1002);
  EXPECT_EQ(sizes.front(), 16);
  EXPECT_EQ(std::ranges::max(sizes), 64);
  EXPECT_LE(sizes.back(), 16);
  for (std::size_t i = 0; i + 1 < sizes.size(); ++i) EXPECT_EQ(sizes[i] % 16, 0) << i;
}

TEST(ParallelRuns, SharesFewGroupsOut) {
  ParallelRuns<int> parallel(
      {.runs = 30, .most_at_once = 64, .workers = {2}, .least_at_once = 32, .group = 8},
      size_of_batch);
  EXPECT_EQ(parallel(), (std::vector{16, 14}));
}

// Results that wait take memory.
TEST(ParallelRuns, RunsNotFarAheadOfTheFirstThatIsNotDone) {
  std::atomic<std::uint32_t> furthest = 0;
  ParallelRuns<int> parallel({.runs = 1000, .most_at_once = 1, .workers = {2}},
                             [&](std::uint32_t first, int, Over) {
                               furthest = std::max<std::uint32_t>(furthest, first);
                               if (first == 0)
                                 std::this_thread::sleep_for(std::chrono::milliseconds(200));
                               return 0;
                             });
  std::uint32_t when_first_was_taken = 1000;
  parallel.in_order([&](int, std::uint32_t) {
    when_first_was_taken = std::min(when_first_was_taken, furthest.load());
    return true;
  });
  EXPECT_LE(when_first_was_taken, 32U);
}

TEST(ParallelRuns, CallsBackWhileABatchTakesLong) {
  std::atomic<int> calls = 0;
  ParallelRuns<int> parallel({1, 1, {1}}, [&](std::uint32_t, int, Over) {
    while (calls < 3) std::this_thread::yield();
    return 0;
  });
  parallel.in_order([](int, std::uint32_t) { return true; }, [&] { ++calls; });
  EXPECT_GE(calls, 3);
}

TEST(ParallelRuns, EndsSoonWhereABatchIsNotTaken) {
  std::atomic<int> done = 0;
  ParallelRuns<int> parallel({1000, 1, {2}}, [&](std::uint32_t, int, Over) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return ++done;
  });
  const auto refuse = [](int, std::uint32_t) -> bool { throw std::runtime_error("no more"); };
  EXPECT_THROW(parallel.in_order(refuse), std::runtime_error);
  EXPECT_LT(done, 1000);
}

TEST(ParallelRuns, ThrowsWhatAThreadThrewAndDoesNoMore) {
  int done = 0;
  ParallelRuns<int> parallel({1000, 1, {1}}, [&](std::uint32_t first, int, Over) {
    if (first == 3) throw std::runtime_error("the fourth");
    return ++done;
  });
  EXPECT_THROW(parallel(), std::runtime_error);
  EXPECT_EQ(done, 3);
}

}  // namespace
}  // namespace sim
