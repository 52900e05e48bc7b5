// The port of a line that is played: which bytes a reader gets, readers that are late, stall or go,
// changes while it runs, and how it ends.
#include <regex>

#include "serve_process.hpp"
#include "sim/text/escaped_text.hpp"

namespace {

const std::string damaged = "receiver.ebn0_db=7";

TEST_F(Serve, GivesItsReaderTheBytesOfItsMessages) {
  for (const std::string& set : {std::string("receiver.ebn0_db=20"), damaged}) {
    const auto line = ready({"bits.toml", "--set", set, "--speed", "100"});
    const PortReader reader(path("ttyCOSYS"));
    std::string messages;
    for (std::uint64_t k = 0; k < 12; ++k) {
      const auto json = line->wait_until("a message", [](const auto&) { return true; });
      EXPECT_EQ(json.at("message"), k);
      EXPECT_EQ(json.at("sent"), "IND 011111 OK");
      EXPECT_EQ(json.at("bytes_lost"), 0);
      messages += json.dump() + "\n";
    }
    const std::string heard = heard_in(messages);
    std::string got;
    while (sim::escaped(got).size() < heard.size()) got += reader.read(1);
    EXPECT_TRUE(sim::escaped(got).starts_with(heard)) << sim::escaped(got) << "\n" << heard;
    EXPECT_EQ(heard.find("IND 011111 OK 46\\x0aIND 011111 OK 46\\x0a") == 0, set != damaged);
    line->write("quit\n");
    EXPECT_EQ(line->finish().code, 0);
  }
}

TEST_F(Serve, SaysTheSameAtAnySpeedAndAgain) {
  const auto at = [&](const std::string& speed, const std::string& seed) {
    return messages(
        {"bits.toml", "--set", damaged, "--duration", "20s", "--speed", speed, "--seed", seed});
  };
  const std::string all = at("1000", "1");
  EXPECT_GT(std::ranges::count(all, '\n'), 15);
  EXPECT_EQ(all, at("1000", "1"));
  EXPECT_EQ(all, at("77.7", "1"));
  EXPECT_NE(all, at("1000", "2"));
}

TEST_F(Serve, EndsWhenItsDurationWasPlayedThoughItIsLate) {
  const Words words{"module.toml", "--duration", "12s", "--speed"};
  const auto at = [&](const std::string& speed) {
    Words all = words;
    all.push_back(speed);
    return messages(all);
  };
  EXPECT_EQ(at("1000000"), at("20"));
}

TEST_F(Serve, SaysOnceThatTheMachineIsTooSlow) {
  const auto line =
      start({"module.toml", "--start-at-once", "--speed", "1000000", "--duration", "100s"});
  const std::string err = line->finish().err;
  const std::string late =
      "s late (the machine takes longer than --speed 1000000 allows) lower "
      "it; bytes keep their order\n";
  const std::size_t first = err.find(late);
  EXPECT_NE(first, std::string::npos) << err;
  EXPECT_EQ(err.find(late, first + 1), std::string::npos) << err;
}

TEST_F(Serve, LeavesBytesWithoutAStopBitOut) {
  const Words words{"bits.toml", "--set", damaged, "--duration", "20s", "--speed", "1000"};
  const std::string all = messages(words);
  Words dropping = words;
  dropping.emplace_back("--drop-framing-errors");
  const std::string rest = messages(dropping);
  EXPECT_GT(sum_of(all, "framing_errors"), 0U);
  EXPECT_EQ(sum_of(rest, "framing_errors"), 0U);
  EXPECT_EQ(sum_of(rest, "bytes_lost"), sum_of(all, "bytes_lost") - sum_of(all, "framing_errors"));
}

TEST_F(Serve, BeginsWhenSomebodyComes) {
  const auto line = ready({"bits.toml", "--speed", "100"});
  line->close_stdin();
  const PortReader reader(path("ttyCOSYS"));
  EXPECT_TRUE(reader.read(message.size()).starts_with(message));
  const Outcome o = line->finish(SIGTERM);
  EXPECT_TRUE(o.out.starts_with("{\"format_version\":\"1\",\"message\":0,")) << o.out;
  EXPECT_EQ(sum_of(o.out, "bytes_lost"), 0U);
  EXPECT_NE(o.err.find("ttyCOSYS; it starts when somebody opens it\n"), std::string::npos) << o.err;
}

TEST_F(Serve, EndsWithoutAReader) {
  const auto line = ready({"bits.toml"});
  line->write("quit\n");
  const Outcome o = line->finish();
  EXPECT_EQ(o.code, 0);
  EXPECT_EQ(o.out, "");
  EXPECT_TRUE(
      o.err.ends_with("cosys-sim: played: 0 messages, 0 of them ok; 0 bytes, 0 of them lost\n"))
      << o.err;
}

TEST_F(Serve, GoesOnWhenItsReaderGoesAndGivesTheNextOneNothingStale) {
  const auto line = ready({"bits.toml", "--speed", "100"});
  const auto sent = [](const std::string& what, std::uint64_t bytes_lost) {
    return [=](const nlohmann::json& json) {
      return json.at("sent") == what && json.at("bytes_lost") == bytes_lost;
    };
  };
  {
    const PortReader reader(path("ttyCOSYS"));
    reader.read_until(message);
    reader.write("this goes nowhere");
    for (int unread = 0; unread < 3; ++unread)
      line->wait_until("a message at the port", sent("IND 011111 OK", 0));
  }
  line->wait_until("a message that is lost", sent("IND 011111 OK", 17));
  line->write("device.message=NEW\n");
  line->wait_until("a new message that is lost", sent("NEW", 7));
  {
    const PortReader reader(path("ttyCOSYS"));
    line->wait_until("a new message at the port", sent("NEW", 0));
    const std::string text = reader.read_until("NEW 5c\n");
    EXPECT_EQ(text.find("IND"), std::string::npos) << text;
  }
  line->wait_until("a new message that is lost", sent("NEW", 7));
  EXPECT_EQ(line->finish(SIGTERM).code, 130);
}

TEST_F(Serve, LosesBytesOfAReaderThatStalls) {
  const auto line =
      ready({"bits.toml", "--set", "device.message=" + std::string(240, 'x'), "--speed", "2000"});
  const PortReader reader(path("ttyCOSYS"));
  const auto loses = [](const nlohmann::json& json) {
    return json.contains("message") && json["bytes_lost"] == 244;
  };
  const auto is_read = [](const nlohmann::json& json) {
    return json.contains("message") && json["bytes_lost"] == 0;
  };
  line->wait_until("loss", loses);
  EXPECT_TRUE(reader.read(1).starts_with(std::string(240, 'x')));  // what waited
  while (reader.has_more()) reader.read(1);
  line->wait_until("bytes that are read again", is_read);
  EXPECT_EQ(line->finish(SIGINT).code, 130);
}

/// The number behind these words.
std::uint64_t number_behind(const std::string& words, const std::string& text) {
  const std::size_t at = text.find(words);
  return at == std::string::npos ? 0 : std::stoull(text.substr(at + words.size()));
}

TEST_F(Serve, ChangesWhileItRuns) {
  const auto line = ready({"module.toml", "--speed", "50"});
  const PortReader reader(path("ttyCOSYS"));
  wait_for_outcome(*line, "ok");
  line->write("receiver.range_m=900\n");
  const auto dark = wait_for_outcome(*line, "nothing");
  EXPECT_EQ(dark.at("heard"), "");
  line->write("device.message=IND 9 OK\r\n\nreceiver.range_m=0.5\n");
  EXPECT_EQ(wait_for_outcome(*line, "ok").at("sent"), "IND 9 OK");
  line->close_stdin();
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(wait_for_outcome(*line, "ok").at("heard"), "IND 9 OK 7e\\x0a");
  reader.read_until("\nIND 9 OK 7e\n");
  const Outcome o = line->finish(SIGTERM);
  EXPECT_EQ(o.code, 130);
  EXPECT_EQ(number_behind("cosys-sim: receiver.range_m=900 from message ", o.err),
            dark.at("message"));
}

TEST_F(Serve, AnswersLinesThatAreWrongAndChangesNothing) {
  const Words words{"bits.toml", "--duration", "20s", "--speed", "1000"};
  const std::string expected = messages(words);
  const auto line = ready(words);
  line->write("receiver.range_m=-1\nreceiver.rage_m=1\nsimulation.seed=3\n\nnonsense\n");
  line->await_words("nonsense");
  const PortReader reader(path("ttyCOSYS"));
  const Outcome o = line->finish();
  EXPECT_EQ(o.code, 0);
  EXPECT_EQ(heard_in(o.out), heard_in(expected));
  // A machine that does other things may be late, and says so.
  const std::string said =
      std::regex_replace(o.err, std::regex("cosys-sim: the line is [0-9.]+ s late .*\n"), "");
  const std::size_t first = said.find('\n') + 1;
  EXPECT_EQ(
      said.substr(first, said.rfind("cosys-sim: played:") - first),
      "cosys-sim: receiver.range_m = -1 in --set (distance along the floor must be at least 0.01 "
      "m) use a value 0.01 to 1000\n"
      "cosys-sim: receiver.rage_m in --set (no such key) did you mean receiver.range_m?\n"
      "cosys-sim: cannot change simulation.seed (it says how the line is simulated) end this one "
      "and start another with --set\n"
      "cosys-sim: \"nonsense\" in --set (no = in it) write key=value, such as "
      "receiver.range_m=3\n");
}

TEST_F(Serve, EndsAtASignalAndRemovesItsLink) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const auto line = ready({"bits.toml", "--speed", "100"});
    const PortReader reader(path("ttyCOSYS"));
    wait_for_outcome(*line, "ok");
    const Outcome o = line->finish(signal);
    EXPECT_EQ(o.code, 130);
    EXPECT_NE(o.err.find(stopping), std::string::npos);
    EXPECT_EQ(files(), (std::set<std::string>{"bits.toml", "module.toml"}));
  }
}

TEST_F(Serve, HasARawPortOfItsSpeedAndName) {
  const auto line = start({"bits.toml", "--set", "device.baud=1200", "--link", "robot"});
  line->await_words(is_at + path("robot").string());
  const termios raw = PortReader(path("robot")).settings();
  EXPECT_EQ(raw.c_lflag & (ICANON | ECHO | ISIG | IEXTEN), 0U);
  EXPECT_EQ(raw.c_iflag & (ICRNL | INLCR | IGNCR | IXON | IXOFF | ISTRIP | INPCK), 0U);
  EXPECT_EQ(raw.c_oflag & OPOST, 0U);
  EXPECT_EQ(::cfgetispeed(&raw), static_cast<speed_t>(B1200));
  EXPECT_EQ(line->finish(SIGTERM).code, 130);
}

TEST_F(Serve, RefusesWhatIsNoLine) {
  write("sweep.toml", "[sweep]\nreceiver.range_m = [1, 2]\n");
  expect_refused({"serve", "sweep.toml"}, 2,
                 "receiver.range_m has several values in sweep.toml:2 (a line is at one point) "
                 "give one, such as receiver.range_m=1");
  write("arena.toml", "experiment = 'location'\n");
  expect_refused({"serve", "arena.toml"}, 2,
                 "arena.toml (an experiment \"location\" has no trials of a link) serve takes "
                 "links; use run");
  write("taken", "precious");
  expect_refused({"serve", "bits.toml", "--link", "taken"}, 2,
                 "cannot make the link taken (something else has this name) choose another name, "
                 "or remove it");
  expect_refused({"serve", "bits.toml", "--speed", "0"}, 2,
                 "--speed: 0 is no number from 0.001 to 1000000 (wrong usage) see cosys-sim serve "
                 "--help");
}

TEST_F(Serve, EndsWhenItsMessagesCannotBeWritten) {
  const Outcome o =
      program({"serve", "bits.toml", "--json", "--start-at-once", "--speed", "1000"}, "/dev/full");
  EXPECT_EQ(o.code, 3);
  EXPECT_TRUE(o.err.ends_with(
      "cannot write to standard output (it is closed or full) redirect it elsewhere\n"))
      << o.err;
  EXPECT_FALSE(std::filesystem::is_symlink(path("ttyCOSYS")));
}

// As robots' programs open it.
TEST_F(Serve, PyserialReadsIt) {
  const std::string python = "/usr/bin/python3";
  if (start_tool(python, {"-c", "import serial"}).finish().code != 0)
    GTEST_SKIP() << "needs /usr/bin/python3 with pyserial (Debian: python3-serial)";
  const auto line = ready({"bits.toml", "--speed", "10"});
  const std::string read =
      "import serial, sys\n"
      "port = serial.Serial('ttyCOSYS', 600, timeout=30)\n"
      "for i in range(5): sys.stdout.write(port.read_until(b'\\n').decode())\n";
  EXPECT_TRUE(tool(python, {"-c", read}).ends_with(message + message + message + message));
  EXPECT_EQ(line->finish(SIGTERM).code, 130);
}

}  // namespace
