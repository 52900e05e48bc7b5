// A node at a device that the test plays: what is on the line, and what a bad line does.
#include "node_process.hpp"

namespace {

using protocol::SharedLinkFieldType;

std::string lat(const std::string& value) {
  return from_guard({{SharedLinkFieldType::index, "0"}, {SharedLinkFieldType::data, value}});
}

TEST_F(Nodes, LeaveOutWhatHasNotChanged) {
  write_like("base.toml", "full_set_period_s = 3600", "rare.toml");
  const TestDevice device;
  const auto base = ready_node({"rare.toml", "--device", device.name()});
  const std::string all = device.read_until("\r\n");
  EXPECT_TRUE(all.starts_with("[:BA|N0|Dgate 3|D1.5|C")) << all;
  base->write("Speed=2\n");
  const std::string part = device.read_until("\r\n");
  EXPECT_TRUE(part.starts_with("[:BA|N1|D2|C")) << part;
  base->write("{\"set\": {\"Goal\": \"x\", \"Speed\": \"3\"}}\n");
  EXPECT_EQ(device.read_until("|C"), "[:BA|N0|Dx|D3|C");
}

TEST_F(Nodes, SayAllWithoutCompression) {
  write_like("base.toml", "compressed = false", "plain.toml");
  const TestDevice device;
  const auto base = ready_node({"plain.toml", "--device", device.name()});
  const std::string all = device.read_until("\r\n");
  for (int i = 0; i < 3; ++i) EXPECT_EQ(device.read_until("\r\n"), all);
}

TEST_F(Nodes, GoOnBehindTheEndOfStdin) {
  const TestDevice device;
  const auto base = base_at(device);
  base->write("Goal=the last");  // without a newline
  base->close_stdin();
  device.read_until("|Dthe last|");
  device.write(from_guard({{SharedLinkFieldType::query, "Speed"}}));
  device.read_until("[:BA|RSpeed|D1.5|C");
  device.write(lat("7"));
  base->wait_for_value("Lat", "7");
  EXPECT_EQ(base->finish(SIGTERM).code, 130);
}

TEST_F(Nodes, PassOverWrongLinesOfStdin) {
  const TestDevice device;
  const auto base = base_at(device);
  base->write("Gaol=1\n\n" + std::string(70'000, 'x') + "\n\xff\nGoal=right\n");
  device.read_until("|Dright|");
  const Outcome o = base->finish(SIGTERM);
  EXPECT_EQ(o.code, 130);
  EXPECT_EQ(
      o.err,
      "cosys-sim: cannot set Gaol (no such outbound variable) did you mean Goal?\n"
      "cosys-sim: cannot read a line of stdin (longer than 64 KiB) write Name=value or ?Name\n"
      "cosys-sim: cannot read a line of stdin (neither a value nor a question) write "
      "Name=value or ?Name\n" +
          stopping);
}

TEST_F(Nodes, ADeviceThatVanishesInMidMessageEndsThem) {
  write("listener.toml", "address = \"A\"\npeer = \"B\"\ninbound = [\"Lat\"]\n");
  for (const char* file : {"base.toml", "listener.toml"}) {
    TestDevice device;
    const auto node = ready_node({file, "--device", device.name()});
    device.write(lat("1") + "[:AB|N0|D12");
    node->wait_for_value("Lat", "1");
    device.vanish();
    const Outcome o = node->finish();
    EXPECT_EQ(o.code, 3);
    EXPECT_EQ(o.err, "cosys-sim: " + device.name() +
                         " vanished (it was unplugged, or its other end closed) plug it in and "
                         "start again\n");
    EXPECT_EQ(end_of(o)["reason"], "failure");
    EXPECT_EQ(end_of(o)["accepted"], 1);
  }
}

TEST_F(Nodes, GarbageDoesNoHarm) {
  const TestDevice device;
  const auto base = base_at(device);
  const std::string message = lat("8");
  std::string garbage;
  for (int i = 0; i < 1000; ++i) garbage += static_cast<char>(i * 73);
  device.write(message.substr(0, 9) + garbage + message + lat("9") + "[:AB|N0|D1|C00]");
  base->wait_for("rejected", {{"reason", "unended"}});
  base->wait_for_value("Lat", "8");
  base->wait_for_value("Lat", "9");
  const auto wrong = base->wait_for("rejected");
  EXPECT_EQ(wrong["reason"], "wrong_checksum");
  EXPECT_EQ(wrong["message"], ":AB|N0|D1|C00");
  device.write("[:AB|N0|D\x01|C00]" + from_guard({{SharedLinkFieldType::query, "Nobody"}}));
  EXPECT_EQ(base->wait_for("rejected")["message"], ":AB|N0|D\\x01|C00");
  EXPECT_EQ(base->wait_for("rejected")["reason"], "unknown_asked");
  EXPECT_EQ(end_of(base->finish(SIGINT))["rejected"]["wrong_checksum"], 1);
}

// What is not read fills the device. Then whole messages are dropped, and nothing waits.
TEST_F(Nodes, AReaderThatNeverReadsDoesNotStopThem) {
  write_like("base.toml", "compressed = false\nquery_timeout_s = 0.1", "much.toml");
  const TestDevice device;
  const auto base = ready_node({"much.toml", "--device", device.name(), "--baud", "4000000"});
  base->write("Goal=" + std::string(200, 'x') + "\n?Lat\n");
  base->wait_for("blocked");
  device.write(lat("5"));
  base->wait_for_value("Lat", "5");
  base->write("Goal=latest\n?Lon\n");
  base->wait_for("timed_out", {{"name", "Lon"}});  // asked for in vain: no message went out
  std::istringstream heard(device.read_until("|Dlatest|D1.5|C") + "??]\r\n");
  for (std::string line; std::getline(heard, line);) {
    EXPECT_TRUE(line.starts_with("[:BA|")) << line;
    EXPECT_TRUE(line.ends_with("]\r")) << line;
    EXPECT_EQ(line.find('[', 1), std::string::npos) << line;
  }
  const Outcome o = base->finish(SIGTERM);
  EXPECT_EQ(o.code, 130);
  EXPECT_GT(end_of(o)["dropped"], 0);
}

TEST_F(Nodes, SayAgainWhatWasDropped) {
  write_like("base.toml", "full_set_period_s = 3600", "rare.toml");
  const TestDevice device;
  const auto base = ready_node({"rare.toml", "--device", device.name()});
  device.read_until("\r\n");
  device.stop();
  base->write("Speed=9\n");
  base->wait_for("blocked");
  device.resume();
  device.read_until("[:BA|N0|Dgate 3|D9|C");
}

TEST_F(Nodes, ALateUserOfTheLinkGetsNothingStale) {
  write_like("base.toml", "compressed = false\nquery_timeout_s = 0.1", "much.toml");
  const auto base = ready_node({"much.toml", "--pty", "line", "--baud", "4000000"});
  base->write("Goal=" + std::string(200, 'x') + "\n");
  const int lazy = ::open(path("line").c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  base->wait_for("blocked");
  base->write("Goal=fresh\n?Lon\n");
  base->wait_for("timed_out");
  ::close(lazy);
  base->wait_for("disconnected");
  const int late = ::open(path("line").c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  read_until(late, "[");  // behind the end of a message that had begun
  EXPECT_TRUE(read_until(late, "]").starts_with(":BA|N0|Dfresh|D1.5|C"));
  ::close(late);
}

}  // namespace
