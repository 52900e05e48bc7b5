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

  void trace(const std::string& more) const {
    write("s.toml", "[simulation]\nwarmup_messages = 19\n" + more);
    ASSERT_EQ(program({"trace", "s.toml", "-o", "t.vcd"}).code, 0);
  }

  /// simavr's pins are named; it ends with the file, which must leave the firmware time to speak.
  std::string as_pin(const std::string& wire) const {
    std::string vcd = content(path("t.vcd"));
    const std::size_t name = vcd.find(" " + wire + " $end");
    const char code = vcd.at(name - 1);
    vcd.replace(name + 1, wire.size(), "iogD_2");
    const long end_us = std::stol(vcd.substr(vcd.rfind('#') + 1));
    for (const long later_us : {100'000, 200'000})
      vcd += "#" + std::to_string(end_us + later_us) + "\n1" + code + "\n";
    return vcd;
  }

  Heard heard(const std::string& wire) const {
    write("pin.vcd", as_pin(wire));
    const Outcome o =
        start_tool("simavr", {"-m", "atmega328p", "-f", "1000000", "-i", "pin.vcd", image})
            .finish();
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
  trace("[receiver]\nmodule = 'TSSP4056'\nrange_m = 1\n");
  for (const char* wire : {"tx", "rx"}) {
    const Heard all = heard(wire);
    EXPECT_EQ(all.messages, std::vector<std::string>(20, message)) << wire;
    EXPECT_EQ(all.bad_lines, 0) << wire;
  }
}

TEST_F(Firmware, HearsEveryOtherMessageToo) {
  for (const std::string sent : {"RFID S:U P:12 ~!", "IND 100000 E7", "BEACON 0123456789 .,-"}) {
    trace("[device]\nmessage = '" + sent + "'\n[receiver]\nmodule = 'TSSP4056'\nrange_m = 1\n");
    EXPECT_EQ(heard("rx").messages, std::vector<std::string>(20, sent));
  }
}

// At the range where the module begins to lose: some lines arrive, some are damaged.
TEST_F(Firmware, TakesNoWrongMessageOfANoisyLink) {
  std::size_t messages = 0;
  int bad_lines = 0;
  for (const char* range_m : {"12.3", "12.4", "12.5"}) {
    trace(std::string("[receiver]\nmodule = 'TSSP4056'\nrange_m = ") + range_m + "\n");
    const Heard some = heard("rx");
    for (const std::string& text : some.messages) EXPECT_EQ(text, message);
    messages += some.messages.size();
    bad_lines += some.bad_lines;
  }
  EXPECT_GT(messages, 10U);
  EXPECT_LT(messages, 50U);
  EXPECT_GT(bad_lines, 10);
}

}  // namespace
