// An AVR as the judge of our wires: simavr runs tests/firmware/receiver.c, which has the COSYS
// document's rules but none of our code, on the VCD that `trace` writes.
#include <algorithm>

#include "program.hpp"

namespace {

struct Heard {
  std::vector<std::string> messages;
  int bad_lines = 0;
};

class Firmware : public CommandLine {
 protected:
#ifdef COSYS_FIRMWARE
  static constexpr const char* image = COSYS_FIRMWARE;
#else
  static constexpr const char* image = "";
  void SetUp() override { GTEST_SKIP() << "needs avr-gcc, avr-libc and simavr"; }
#endif

  /// What the firmware hears of so many messages. simavr ends with the file, which must leave it
  /// time to speak.
  Heard heard(int messages, const std::string& scenario) const {
    write("s.toml",
          "[simulation]\nwarmup_messages = " + std::to_string(messages - 1) + "\n" + scenario);
    const Words traced{"trace", "s.toml", "-o", "t.vcd", "--pin", "iogD_2", "--tail", "0.2s"};
    if (program(traced).code != 0) throw std::runtime_error("no trace");  // simavr would not end
    return heard_in_file();
  }

  /// The same of the wire that keys the LED, in the file of that trace.
  Heard heard_of_sender() const {
    std::string vcd = content(path("t.vcd"));
    const std::string pin = " iogD_2 $end", sender = " tx $end";
    vcd.replace(vcd.find(pin), pin.size(), " rx $end");
    vcd.replace(vcd.find(sender), sender.size(), pin);
    write("t.vcd", vcd);
    return heard_in_file();
  }

 private:
  Heard heard_in_file() const {
    const Outcome o =
        start_tool("simavr", {"-m", "atmega328p", "-f", "1000000", "-i", "t.vcd", image}).finish();
    EXPECT_EQ(o.code, 0);
    std::istringstream lines(o.err);  // where it shows what a UART sends
    Heard heard;
    for (std::string line; std::getline(lines, line);) {
      const std::size_t ok = line.find("ok ");  // behind the colour of simavr's terminal
      if (ok != std::string::npos)              // simavr shows the end of a line as a dot
        heard.messages.push_back(line.substr(ok + 3, line.rfind('.') - ok - 3));
      heard.bad_lines += line.find("bad") != std::string::npos;
    }
    return heard;
  }
};

const std::string message = "IND 011111 OK";

TEST_F(Firmware, HearsEveryMessageOfAClearLink) {
  const Heard received = heard(10, "[receiver]\nmodule = 'TSSP4056'\nrange_m = 1\n");
  for (const Heard& all : {received, heard_of_sender()}) {
    EXPECT_EQ(all.messages, std::vector<std::string>(10, message));
    EXPECT_EQ(all.bad_lines, 0);
  }
}

TEST_F(Firmware, HearsEveryOtherMessageToo) {
  for (const std::string sent : {"RFID S:U P:12 ~!", "IND 100000 E7", "BEACON 0123456789 .,-"}) {
    const Heard all = heard(
        5, "[device]\nmessage = '" + sent + "'\n[receiver]\nmodule = 'TSSP4056'\nrange_m = 1\n");
    EXPECT_EQ(all.messages, std::vector<std::string>(5, sent));
  }
}

// At the range where the module begins to lose: some lines arrive, some are damaged.
TEST_F(Firmware, TakesNoWrongMessageOfANoisyLink) {
  std::size_t messages = 0;
  int bad_lines = 0;
  for (const char* range_m : {"12.3", "12.4", "12.5"}) {
    const Heard some =
        heard(20, std::string("[receiver]\nmodule = 'TSSP4056'\nrange_m = ") + range_m + "\n");
    for (const std::string& text : some.messages) EXPECT_EQ(text, message);
    messages += some.messages.size();
    bad_lines += some.bad_lines;
  }
  EXPECT_GT(messages, 10U);
  EXPECT_LT(messages, 50U);
  EXPECT_GT(bad_lines, 10);
}

}  // namespace
