// Pure ALOHA: in the limit of many alike, long pauses and no capture, arenas are it.
#include <cmath>

#include "arena_scenes.hpp"
#include "gtest/gtest.h"
#include "sim/arena/airtime.hpp"

namespace sim {
namespace {

/// Mean and its standard error of what independent runs gave.
struct Mean {
  double value, error;
};

Mean mean_of(const std::vector<double>& x) {
  const auto n = static_cast<double>(x.size());
  double sum = 0, squares = 0;
  for (const double v : x) sum += v;
  for (const double v : x) squares += (v - sum / n) * (v - sum / n);
  return {sum / n, std::sqrt(squares / (n * (n - 1)))};
}

std::string crowd(int n, const char* pauses_ms) {
  return "[arena]\nduration_s = 60\nruns = 16\n" +
         device("crowd", "1",
                "count = " + std::to_string(n) + "\ninterval_min_ms = " + pauses_ms +
                    "carrier_spread_ppm = 2000\nmessages = \"IND {} OK\"");
}

// Abramson's terminals send at random times. Ours repeat themselves, but each begins at a time of
// its own and pauses for long beside a message of length F: how often one of period P begins within
// F before or behind the start of another's is then 2 F / P, whatever it did before, as two that
// have drifted apart by random pauses know nothing of each other. With N - 1 of them and
// G = N F / P, (1 - 2 F / P)^(N - 1) tends to exp(-2 G (N - 1) / N) for F / P -> 0.
TEST(PureAloha, MeasuredTheShareThatMeetsNobodyIsExponentialInTheLoad) {
  for (const int n : {2, 50, 150}) {
    const Arena arena =
        arena_of(crowd(n, "20000\ninterval_max_ms = 60000\n"), {"arena.duration_s=300"});
    std::vector<double> alone, load;
    for (std::uint32_t run = 0; run < 100; ++run) {
      std::vector<SentFrames> sent;
      for (const Sender& sender : arena.senders)
        sent.push_back(send(sender, {.seed = 1, .point = sender.point, .trial = run, .purpose = 12},
                            arena.end));
      const Airtime air(arena, sent);
      double frames = 0, clear = 0, airtime = 0;
      for (std::size_t i = 0; i < sent.size(); ++i)
        for (const SentFrame& frame : sent[i].frames) {
          if (frame.start.value < 0 || frame.start >= arena.duration) continue;
          ++frames;
          clear += !air.overlapped(i, frame);
          airtime += (frame.end - frame.start).value;
        }
      alone.push_back(clear / frames);
      load.push_back(airtime / arena.duration.value);
    }
    const Mean share = mean_of(alone);
    const double g = mean_of(load).value, others = (n - 1.0) / n;
    // What F / P > 0 makes of it: (1 - x)^m is below exp(-m x) by m x^2 / 2 of itself.
    const double expected = std::exp(-2 * g * others), finite = 2 * g * g / n * expected;
    EXPECT_NEAR(share.value, expected, 3.3 * share.error + finite) << n << " devices, G = " << g;
    EXPECT_LT(share.error + finite, 0.02);
  }
}

// Through the chain: of equal lights none captures, and what meets nobody is delivered but where
// a collision shortly before it left the line without its end. At a small load that is rare.
TEST(PureAloha, MeasuredThroughputIsOnItsCurveAtASmallLoad) {
  constexpr int n = 16;
  const ArenaPoint point =
      arena_point(crowd(n, "25000\ninterval_max_ms = 95000\n"), {"arena.runs=32"});
  const SenderTally all = together(point);
  std::vector<double> delivered(point.tally.n_runs);
  for (const HeardFrame& heard : point.heard)
    delivered[heard.run] += (heard.end_s - heard.start_s) / point.duration_s;
  const Mean s = mean_of(delivered);
  const double g = offered_load(point, all);
  EXPECT_NEAR(s.value, throughput(point, all), 1e-6);
  EXPECT_NEAR(s.value, g * std::exp(-2 * g * (n - 1) / n), 3.3 * s.error) << "G = " << g;
  EXPECT_LT(static_cast<double>(all.n_captured), 0.1 * static_cast<double>(all.n_overlapped));
  EXPECT_GT(all.n_overlapped, 20u);
  EXPECT_LT(all[LossCause::uart] + all[LossCause::checksum], all.n_overlapped / 4);
}

TEST(PureAloha, MeasuredHasItsMaximumWhereAbramsonSays) {
  EXPECT_NEAR(pure_aloha(0.5), 1 / (2 * std::exp(1)), 1e-12);
  EXPECT_LT(pure_aloha(0.49), pure_aloha(0.5));
  EXPECT_LT(pure_aloha(0.51), pure_aloha(0.5));
}

}  // namespace
}  // namespace sim
