// What a device of an arena sends: which message, after which pause, and when it is silent.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "arena_scenes.hpp"
#include "counted_points.hpp"
#include "gtest/gtest.h"
#include "protocol/cosys.hpp"
#include "protocol/uart_receivers.hpp"
#include "sim/arena/arena_columns.hpp"
#include "sim/columns/columns_dataset.hpp"

namespace sim {
namespace {

using dsp::Seconds;

Sender sender_of(const std::string& more, const std::vector<std::string>& set = {}) {
  return make_senders(point_scenario(loaded_arena(device("a", "2", more), set), {})).front();
}

SentFrames sent_by(const Sender& sender, double seconds, std::uint32_t run = 0) {
  return send(sender, {.seed = 1, .point = 5, .trial = run, .purpose = 12}, Seconds(seconds));
}

std::vector<double> pauses_ms(const SentFrames& sent) {
  std::vector<double> pauses;
  for (std::size_t i = 1; i < sent.frames.size(); ++i)
    pauses.push_back((sent.frames[i].start - sent.frames[i - 1].end).value * 1e3);
  return pauses;
}

double mean(const std::vector<double>& x) {
  double sum = 0;
  for (const double value : x) sum += value;
  return sum / static_cast<double>(x.size());
}

// ---- messages ----

TEST(ArenaMessages, AListIsSentInOrder) {
  const auto sent =
      sent_by(sender_of("source = \"list\"\nmessages = [\"A\", \"B\", \"C {}\"]"), 60);
  const std::map<std::string, std::string> next{{"A", "B"}, {"B", "C 1"}, {"C 1", "A"}};
  ASSERT_GT(sent.frames.size(), 50u);
  for (std::size_t i = 1; i < sent.frames.size(); ++i)
    EXPECT_EQ(sent.frames[i].message, next.at(sent.frames[i - 1].message));
}

TEST(ArenaMessages, FixedIsTheFirstAlways) {
  for (const SentFrame& frame : sent_by(sender_of("messages = [\"A\", \"B\"]"), 30).frames)
    EXPECT_EQ(frame.message, "A");
}

TEST(ArenaMessages, ACounterCounts) {
  const auto sent = sent_by(sender_of("source = \"counter\"\nmessages = \"N\""), 60);
  int before = -1;
  for (const SentFrame& frame : sent.frames) {
    ASSERT_EQ(frame.message.size(), 1 + counter_size);
    ASSERT_EQ(frame.message.substr(0, 2), "N ");
    const int count = std::stoi(frame.message.substr(2));
    if (before >= 0) {
      EXPECT_EQ(count, before + 1);
    }
    before = count;
  }
}

// Spells of a status: the time from one change to the next is exponential about status_hold_s, and
// each is as likely as the others.
TEST(ArenaMessages, AStatusLastsExponentially) {
  const Sender sender = sender_of(
      "source = \"status\"\nmessages = [\"A\", \"B\", \"C\"]\nstatus_hold_s = 20\n"
      "interval_min_ms = 50\ninterval_max_ms = 50");
  std::vector<double> holds;
  std::map<std::string, double> share;
  for (std::uint32_t run = 0; run < 20; ++run) {
    const auto frames = sent_by(sender, 2000, run).frames;
    double since = -1;
    for (std::size_t i = 1; i < frames.size(); ++i) {
      share[frames[i].message] += 1;
      if (frames[i].message == frames[i - 1].message) continue;
      if (since >= 0) holds.push_back(frames[i].start.value - since);
      since = frames[i].start.value;
    }
  }
  ASSERT_GT(holds.size(), 1500u);
  const double n = static_cast<double>(holds.size()), average = mean(holds);
  EXPECT_NEAR(average / 20, 1, 3.3 / std::sqrt(n));  // an exponential's deviation is its mean
  std::size_t longer = 0;
  for (const double hold : holds) longer += hold > 20;
  EXPECT_NEAR(static_cast<double>(longer) / n, std::exp(-1), 3.3 * std::sqrt(0.24 / n));
  for (const char* status : {"A", "B", "C"})
    EXPECT_NEAR(share[status] / (share["A"] + share["B"] + share["C"]), 1 / 3.0, 0.06) << status;
}

// The one at time 0 is any of them, whichever stands first in the list.
TEST(ArenaMessages, AStatusThatHardlyChangesIsAnyOfTheList) {
  const Sender sender =
      sender_of("source = \"status\"\nmessages = [\"A\", \"B\"]\nstatus_hold_s = 1e6");
  int first = 0;
  constexpr int runs = 400;
  for (std::uint32_t run = 0; run < runs; ++run)
    first += sent_by(sender, 2, run).frames.front().message == "A";
  EXPECT_NEAR(first, runs / 2.0, 3.3 * std::sqrt(runs / 4.0));
}

TEST(ArenaMessages, WhatIsOnTheWireIsTheMessage) {
  const Sender sender = sender_of("messages = \"HELLO\"", {"device.baud=1200"});
  const SentFrames sent = sent_by(sender, 20);
  std::size_t heard = 0;
  protocol::CosysDecoder decoder;
  const auto* uart = protocol::find_uart_receiver("mid-bit");
  for (const auto& byte : uart->receive(sent.drive, dsp::Hertz(1200), 0))
    if (const auto frame = decoder.push(byte)) heard += frame->message == "HELLO";
  EXPECT_GE(heard + 1, sent.frames.size());  // the first may have begun before time 0
  for (const SentFrame& frame : sent.frames)
    EXPECT_NEAR((frame.end - frame.start).value, 9 * 10 / 1200.0, 1e-12);
}

// ---- pauses ----

TEST(ArenaPauses, AreUniform) {
  const auto pauses = pauses_ms(sent_by(sender_of("interval_min_ms = 100"), 3000));
  for (const double pause : pauses) {
    EXPECT_GE(pause, 100 - 1e-6);
    EXPECT_LE(pause, 900 + 1e-6);
  }
  const double deviation = 800 / std::sqrt(12 * static_cast<double>(pauses.size()));
  EXPECT_NEAR(mean(pauses), 500, 3.3 * deviation);
  EXPECT_LT(*std::ranges::min_element(pauses), 105);
  EXPECT_GT(*std::ranges::max_element(pauses), 895);
}

TEST(ArenaPauses, AreFixedWhereTheirBoundsAreEqual) {
  for (const double pause :
       pauses_ms(sent_by(sender_of("interval_min_ms = 250\ninterval_max_ms = 250"), 60)))
    EXPECT_NEAR(pause, 250, 1e-6);
}

TEST(ArenaPauses, OfAListComeInTurn) {
  const auto pauses = pauses_ms(sent_by(sender_of("intervals_ms = [100, 250, 900]"), 60));
  const std::map<int, int> next{{100, 250}, {250, 900}, {900, 100}};
  ASSERT_GT(pauses.size(), 60u);
  for (std::size_t i = 1; i < pauses.size(); ++i)
    EXPECT_NEAR(pauses[i], next.at(static_cast<int>(std::lround(pauses[i - 1]))), 1e-6);
}

// Where in its turn a device is at time 0 is nothing that runs have in common: in a turn of a short
// and a long pause any moment is as likely, so the first message after time 0 comes within the
// first quarter of the turn in a quarter of the runs, less what begins there as a pair.
TEST(ArenaPauses, BeginAnywhereInTheirTurn) {
  const Sender sender = sender_of("messages = \"A\"\nintervals_ms = [0, 10000]");
  const double frame = 5 * 10 / 600.0, turn = 10 + 2 * frame;
  constexpr int runs = 2000;
  std::map<int, int> quarters;
  for (std::uint32_t run = 0; run < runs; ++run)
    for (const SentFrame& sent : sent_by(sender, turn, run).frames)
      if (sent.start.value >= 0) ++quarters[static_cast<int>(4 * sent.start.value / turn)];
  for (int quarter = 0; quarter < 4; ++quarter)  // two messages a turn, together
    EXPECT_NEAR(quarters[quarter], 2 * runs / 4.0, 2 * 3.5 * std::sqrt(runs * 3 / 16.0)) << quarter;
}

class IntervalFile : public testing::Test {
 public:
  IntervalFile() {
    std::string name = (std::filesystem::temp_directory_path() / "cosys_arena.XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~IntervalFile() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path file(const std::string& name) const { return folder_ / name; }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name), std::ios::binary) << text;
  }
  LoadedScenario load(const std::string& text) const {
    write("x.toml", arena_head + text);
    return load_scenario(folder_ / "x.toml", {}, {COSYS_SOURCE_DIR "/scenarios"});
  }
  std::string refusal_of(const std::string& text) const {
    try {
      load(text);
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::bad_input);
      std::string line = failure.what();
      for (std::size_t at; (at = line.find(folder_.string())) != std::string::npos;)
        line.replace(at, folder_.string().size(), "HERE");
      return line;
    }
    return "accepted";
  }

 private:
  std::filesystem::path folder_;
};

const std::string from_file = "[devices.a]\nx_m = 1\ninterval_file = \"p.txt\"\n";

TEST_F(IntervalFile, IsAListWithCommentsAndAnyLineEnds) {
  write("p.txt", "# measured\r\n100\r\n\r\n 250.5 \n# more\n900");
  EXPECT_EQ(load(from_file).base.devices.at("a").intervals_ms, "100,250.5,900");
}

// The result's text holds the pauses, so it repeats the run where the file is not.
TEST_F(IntervalFile, IsKeptWithTheResult) {
  const std::string scene = "[arena]\nduration_s = 20\nruns = 2\n" +
                            device("b", "2", "interval_file = \"q.txt\"") +
                            device("a", "3", "interval_file = \"p.txt\"");
  write("p.txt", "100\n300\n");
  write("q.txt", "40\n900\n20\n");
  const LoadedScenario here = load(scene);
  std::filesystem::remove(file("p.txt"));
  std::filesystem::remove(file("q.txt"));
  const LoadedScenario there = parse_scenario(here.text, "elsewhere/y.toml", {}, {});
  const auto digest = [](const LoadedScenario& s) {
    return dataset_digest(
        dataset_of(s, "", arena_columns(), counted_points(arena_measurement, s, {})));
  };
  EXPECT_EQ(digest(there), digest(here));
  EXPECT_EQ(there.text, here.text + there.text.substr(here.text.size()));
  EXPECT_EQ(there.base.devices.at("a").intervals_ms, "100,300");
  EXPECT_LT(here.text.find("devices.a.intervals_ms"), here.text.find("devices.b.intervals_ms"));
}

TEST_F(IntervalFile, ThatCannotBeReadIsRefused) {
  EXPECT_EQ(refusal_of(from_file),
            "devices.a.interval_file = \"p.txt\" in HERE/x.toml:6 (there is no file HERE/p.txt) "
            "correct the name");
  write("p.txt", "100\nsoon\n");
  EXPECT_EQ(refusal_of(from_file),
            "\"soon\" in HERE/p.txt:2 (not a number) write one number a line");
  write("p.txt", "# nothing\n\n");
  EXPECT_EQ(refusal_of(from_file), "in HERE/p.txt (no number in it) write one number a line");
  write("p.txt", "100\n-3\n");
  EXPECT_EQ(refusal_of(from_file),
            "devices.a.intervals_ms = -3 in p.txt (pauses in turn, instead of those must be at "
            "least 0 ms) use a value 0 to 1000000");
  EXPECT_EQ(refusal_of(from_file + "intervals_ms = [5]\n"),
            "devices.a.interval_file = \"p.txt\" in HERE/x.toml:6 (the scenario also has "
            "devices.a.intervals_ms) remove one of the two");
}

// ---- silent spells ----

TEST(ArenaSilence, TakesItsShareOfTime) {
  const Sender sender =
      sender_of("silent_every_s = 6\nsilent_for_s = 4\ninterval_min_ms = 0\ninterval_max_ms = 100");
  double silent = 0, all = 0;
  std::vector<double> lengths;
  for (std::uint32_t run = 0; run < 20; ++run) {
    double since = -1;
    for (const SentFrame& frame : sent_by(sender, 500, run).frames) {
      silent += frame.silent;
      ++all;
      if (frame.silent && since < 0) since = frame.start.value;
      if (!frame.silent && since >= 0) {
        lengths.push_back(frame.start.value - since);
        since = -1;
      }
    }
  }
  // 1000 spells of each kind: the deviation of their ratio is about 1 / sqrt(500).
  EXPECT_NEAR(silent / all, 0.4, 3.3 * 0.4 * 0.6 / std::sqrt(500));
  ASSERT_GT(lengths.size(), 800u);
  // Spells shorter than a message are not seen and some are cut by one, both by little.
  EXPECT_NEAR(mean(lengths), 4, 3.3 * 4 / std::sqrt(static_cast<double>(lengths.size())) + 0.2);
}

// Spells as long as a run are met in the middle, as often as they are.
TEST(ArenaSilence, IsUnderWayWhenARunBegins) {
  const Sender sender = sender_of("silent_every_s = 1e5\nsilent_for_s = 1e5");
  int silent = 0;
  constexpr int runs = 400;
  for (std::uint32_t run = 0; run < runs; ++run)
    silent += sent_by(sender, 2, run).frames.front().silent;
  EXPECT_NEAR(silent, runs / 2.0, 3.3 * std::sqrt(runs / 4.0));
}

TEST(ArenaSilence, IsDark) {
  const Sender sender = sender_of("silent_every_s = 2\nsilent_for_s = 2");
  const SentFrames sent = sent_by(sender, 60);
  std::size_t silent = 0;
  for (const SentFrame& frame : sent.frames) {
    const auto edges = std::ranges::count_if(
        sent.drive.edges(), [&](Seconds t) { return t >= frame.start && t < frame.end; });
    EXPECT_EQ(edges == 0, frame.silent);
    silent += frame.silent;
  }
  EXPECT_GT(silent, 10u);
}

TEST(ArenaSilence, NeverByDefault) {
  for (const SentFrame& frame : sent_by(sender_of(""), 300).frames) EXPECT_FALSE(frame.silent);
}

// ---- devices of a kind ----

TEST(ArenaDevices, OfAKindHavePlacesDirectionsAndClocksOfTheirOwn) {
  const LoadedScenario scenario = loaded_arena(
      "[devices.a]\ncount = 400\nx_m = 2\ny_m = -1\nspread_x_m = 4\nspread_y_m = 2\nyaw_deg = 90\n"
      "yaw_spread_deg = 360\ncarrier_spread_ppm = 2000\nclock_error_ppm = 500\n"
      "clock_spread_ppm = 1000\nmessages = \"NO {} OF {}\"");
  const auto senders = make_senders(point_scenario(scenario, {}));
  ASSERT_EQ(senders.size(), 400u);
  std::set<std::string> names;
  double x = 0, y = 0;
  for (const Sender& s : senders) {
    names.insert(s.name);
    EXPECT_LE(std::fabs(s.x_m - 2), 2);
    EXPECT_LE(std::fabs(s.y_m + 1), 1);
    EXPECT_LE(std::fabs(s.carrier.value / 59e3 - 1), 1e-3);
    EXPECT_LE(std::fabs(s.baud.value / 600 - 1.0005), 5e-4);
    x += s.x_m / 400;
    y += s.y_m / 400;
  }
  EXPECT_EQ(names.size(), 400u);
  EXPECT_NEAR(x, 2, 3.3 * 4 / std::sqrt(12 * 400.0));
  EXPECT_NEAR(y, -1, 3.3 * 2 / std::sqrt(12 * 400.0));
  EXPECT_EQ(senders[16].name, "a-17");
  EXPECT_EQ(senders[16].messages.front(), "NO 17 OF 17");
}

}  // namespace
}  // namespace sim
