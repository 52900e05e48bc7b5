#include "sim/threads/parallel_runs.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>
#include <thread>

namespace sim {
namespace {

using Numbers = std::vector<std::uint32_t>;

Numbers numbers(std::uint32_t first, int n) {
  Numbers of_lot(static_cast<std::size_t>(n));
  std::iota(of_lot.begin(), of_lot.end(), first);
  return of_lot;
}

Numbers joined(const std::vector<Numbers>& batches) {
  Numbers all;
  for (const Numbers& batch : batches) all.insert(all.end(), batch.begin(), batch.end());
  return all;
}

TEST(ParallelRuns, GivesEveryRunOnceInOrderHoweverManyThreadsThereAre) {
  for (const std::uint32_t runs : {0U, 1U, 7U, 100U})
    for (const int threads : {1, 2, 16}) {
      ParallelRuns<Numbers> sharing({runs, 5, {threads}}, numbers);
      EXPECT_EQ(joined(sharing()), numbers(0, static_cast<int>(runs)));
    }
}

TEST(ParallelRuns, DoesNoMoreAtOnceThanAllowedAndLeavesNoThreadWithout) {
  ParallelRuns<int> many({100, 3, {1}}, [](std::uint32_t, int n) { return n; });
  const std::vector<int> of_three = many();
  EXPECT_LE(std::ranges::max(of_three), 3);
  ParallelRuns<int> few({4, 100, {4}}, [](std::uint32_t, int n) { return n; });
  EXPECT_EQ(few(), (std::vector{1, 1, 1, 1}));
}

TEST(ParallelRuns, KeepsWhatWasFinishedBeforeAStop) {
  std::atomic<bool> stop = false;
  ParallelRuns<Numbers> sharing({100, 1, {1, &stop}}, [&](std::uint32_t first, int n) {
    if (first == 4) stop = true;
    return numbers(first, n);
  });
  EXPECT_EQ(joined(sharing()), (Numbers{0, 1, 2, 3}));  // of the fifth nobody knows how far it came
}

TEST(ParallelRuns, LeavesNoGapWhereALaterLotWasFinishedFirst) {
  std::atomic<bool> stop = false;
  ParallelRuns<Numbers> sharing({3, 1, {2, &stop}}, [&](std::uint32_t first, int n) {
    while (first == 0 && !stop) std::this_thread::yield();  // while another thread does the second
    if (first == 2) stop = true;
    return numbers(first, n);
  });
  EXPECT_TRUE(sharing().empty());
}

// Whoever takes them needs no lock, and has the first before the last is done.
TEST(ParallelRuns, GivesLotsInOrderToTheCallingThreadWhileOthersGoOn) {
  std::atomic<bool> first_taken = false;
  ParallelRuns<Numbers> sharing({.runs = 20, .most_at_once = 2, .workers = {3}, .first = 7},
                                [&](std::uint32_t first, int n) {
                                  while (first > 20 && !first_taken) std::this_thread::yield();
                                  return numbers(first, n);
                                });
  const auto caller = std::this_thread::get_id();
  Numbers all;
  std::uint32_t runs = 0;
  sharing.in_order([&](Numbers&& batch, std::uint32_t n) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    EXPECT_EQ(batch.size(), n);
    all.insert(all.end(), batch.begin(), batch.end());
    runs += n;
    first_taken = true;
  });
  EXPECT_EQ(all, numbers(7, 20));
  EXPECT_EQ(runs, 20U);
}

TEST(ParallelRuns, CallsBackWhileALotTakesLong) {
  std::atomic<int> calls = 0;
  ParallelRuns<int> sharing({1, 1, {1}}, [&](std::uint32_t, int) {
    while (calls < 3) std::this_thread::yield();
    return 0;
  });
  sharing.in_order([](int, std::uint32_t) {}, [&] { ++calls; });
  EXPECT_GE(calls, 3);
}

TEST(ParallelRuns, EndsSoonWhereALotIsNotTaken) {
  std::atomic<int> done = 0;
  ParallelRuns<int> sharing({1000, 1, {2}}, [&](std::uint32_t, int) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return ++done;
  });
  const auto refuse = [](int, std::uint32_t) { throw std::runtime_error("no more"); };
  EXPECT_THROW(sharing.in_order(refuse), std::runtime_error);
  EXPECT_LT(done, 1000);
}

TEST(ParallelRuns, ThrowsWhatAThreadThrewAndDoesNoMore) {
  int done = 0;
  ParallelRuns<int> sharing({1000, 1, {1}}, [&](std::uint32_t first, int) {
    if (first == 3) throw std::runtime_error("the fourth");
    return ++done;
  });
  EXPECT_THROW(sharing(), std::runtime_error);
  EXPECT_EQ(done, 3);
}

}  // namespace
}  // namespace sim
