// A reader of a node's events that stalls: the node lives on, ends when it should, and says what
// got lost.
#include <array>

#include "node_process.hpp"
#include "sim/failure.hpp"
#include "sim/node/node_events.hpp"
#include "sim/serial/line_output.hpp"

namespace {

using sim::LineOutput, sim::NodeEvents;

const std::string unread =
    "cosys-sim: standard output was not read to its end (its reader stalled) read it, or redirect "
    "it to a file\n";

/// Bytes that bring about more events than a pipe takes.
std::string many_wrong_messages() {
  std::string all;
  for (int i = 0; i < 2200; ++i) all += "[:AB|N0|D1|C00]";
  return all;
}

TEST_F(Nodes, AReaderOfTheirEventsThatStallsDoesNotStopThem) {
  const TestDevice device;
  const termios before = device.settings();
  const auto base = base_at(device);
  device.write(many_wrong_messages());
  base->write("Goal=still here\n");
  device.read_until("|Dstill here|");
  base->await_exit(SIGTERM);
  EXPECT_EQ(device.settings().c_lflag, before.c_lflag);
  const Outcome o = base->finish();
  EXPECT_EQ(o.code, 3);
  EXPECT_EQ(o.err, stopping + unread);
  EXPECT_TRUE(o.out.ends_with("}\n")) << "whole lines";
}

TEST_F(Nodes, EndInTimeThoughNobodyReadsTheirEvents) {
  const auto base = ready_node({"base.toml", "--pty", "line", "--duration", "1s"});
  const int line = ::open(path("line").c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  write_all(line, many_wrong_messages());
  base->await_exit();
  ::close(line);
  EXPECT_FALSE(std::filesystem::is_symlink(path("line")));
  const Outcome o = base->finish();
  EXPECT_EQ(o.code, 3);
  EXPECT_EQ(o.err, unread);
}

TEST_F(Nodes, SayAllToAReaderThatComesLate) {
  const TestDevice device;
  const auto base = base_at(device);
  device.write(many_wrong_messages() +
               from_guard({{protocol::SharedLinkFieldType::query, "Speed"}}));
  device.read_until("[:BA|RSpeed|");  // so all before it was heard
  const Outcome o = base->finish(SIGTERM);
  EXPECT_EQ(o.code, 130);
  EXPECT_EQ(o.err, stopping);
  EXPECT_EQ(end_of(o)["rejected"]["wrong_checksum"], 2200);
  EXPECT_EQ(end_of(o)["events_lost"], 0);
}

/// A pipe of the least size that Linux has.
class SmallPipe {
 public:
  SmallPipe() {
    std::signal(SIGPIPE, SIG_IGN);
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    ::fcntl(out(), F_SETPIPE_SZ, 4096);
  }
  SmallPipe(const SmallPipe&) = delete;
  SmallPipe& operator=(const SmallPipe&) = delete;
  ~SmallPipe() {
    stop_reading();
    ::close(out());
  }

  int out() const { return ends_[1]; }
  /// What comes, up to and with this.
  std::string read_until(const std::string& end) {
    const Patience patience;
    std::size_t at = std::string::npos, looked_at = 0;
    while ((at = ahead_.find(end, looked_at)) == std::string::npos) {
      looked_at = ahead_.size() - std::min(ahead_.size(), end.size());
      patience.await_input(ends_[0], end);
      char some[4096];
      const ssize_t n = ::read(ends_[0], some, sizeof some);
      if (n <= 0) throw std::runtime_error("the end, behind " + ahead_);
      ahead_.append(some, static_cast<std::size_t>(n));
    }
    const std::string text = ahead_.substr(0, at + end.size());
    ahead_.erase(0, text.size());
    return text;
  }
  void stop_reading() {
    if (ends_[0] >= 0) ::close(std::exchange(ends_[0], -1));
  }

 private:
  std::array<int, 2> ends_{};
  std::string ahead_;
};

TEST(LineOutput, GivesAllInOrder) {
  SmallPipe pipe;
  LineOutput output(pipe.out());
  std::string all;
  for (int i = 0; i < 3000; ++i) {
    all += "line " + std::to_string(i) + "\n";
    output.push("line " + std::to_string(i) + "\n");
  }
  output.push("end\n");
  EXPECT_EQ(pipe.read_until("end\n"), all + "end\n");
  output.finish();
}

TEST(LineOutput, WaitsForAFileThatOthersHaveMadeNonBlocking) {
  SmallPipe pipe;
  ::fcntl(pipe.out(), F_SETFL, O_NONBLOCK);
  LineOutput output(pipe.out());
  for (int i = 0; i < 100; ++i) output.push(std::string(99, 'x') + "\n");
  output.push("end\n");
  EXPECT_EQ(pipe.read_until("end\n").size(), 10'004U);
  output.finish();
}

// In all it takes longer than one that stalls is given.
TEST(LineOutput, WaitsForAReaderThatIsSlow) {
  SmallPipe pipe;
  LineOutput output(pipe.out());
  for (int i = 0; i < 12; ++i) output.push(std::string(4095, 'x') + "\n");
  std::thread reader([&] {
    for (int i = 0; i < 12; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(120));
      pipe.read_until("\n");
    }
  });
  EXPECT_NO_THROW(output.finish());
  reader.join();
}

TEST(LineOutput, SaysThatItsReaderIsGone) {
  SmallPipe pipe;
  pipe.stop_reading();
  LineOutput output(pipe.out());
  output.push("line\n");
  EXPECT_THROW(output.finish(), sim::Failure);
  EXPECT_THROW(output.check(), sim::Failure);
}

const std::string long_name(1000, 'x');

/// Their pipe is full from the start, so it does not depend on time how many of them have room.
class UnreadEvents : public testing::Test {
 protected:
  UnreadEvents() { EXPECT_EQ(::write(pipe.out(), plug.data(), plug.size()), 4096); }

  /// How many there is room for.
  std::uint64_t fill() {
    std::uint64_t n = 0;
    for (; output.has_room(); ++n) events.timed_out(dsp::Seconds(0), long_name);
    return n;
  }
  void read_plug() { EXPECT_EQ(pipe.read_until("\n"), plug); }

  const std::string plug = std::string(4095, '-') + "\n";
  SmallPipe pipe;
  LineOutput output{pipe.out()};
  NodeEvents events{output};
};

TEST_F(UnreadEvents, AreCountedInTheirPlaceIfLost) {
  const std::uint64_t n = fill();
  EXPECT_GT(n, 900U) << "a megabyte";
  for (int i = 0; i < 5; ++i) events.timed_out(dsp::Seconds(0), long_name);
  events.end(dsp::Seconds(7), "duration", {}, {});
  read_plug();
  const std::string all = pipe.read_until("\"unknown_replies\":0}\n");
  EXPECT_EQ(static_cast<std::uint64_t>(std::ranges::count(all, '\n')), n + 2);
  EXPECT_NE(all.find(R"({"time_s":7.0,"event":"lost","events":5})"
                     "\n"
                     R"({"time_s":7.0,"event":"end")"),
            std::string::npos);
  EXPECT_NE(all.find("\"events_lost\":5"), std::string::npos);
}

TEST_F(UnreadEvents, GoOnWhenTheirReaderDoes) {
  const std::uint64_t n = fill();
  read_plug();
  for (std::uint64_t i = 0; i < n; ++i) pipe.read_until("\n");
  events.port(dsp::Seconds(8), "connected");
  EXPECT_EQ(pipe.read_until("\n"), "{\"time_s\":8.0,\"event\":\"connected\"}\n");
}

}  // namespace
