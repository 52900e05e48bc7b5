// decode from outside: how long a capture may be.
#include "program.hpp"

namespace {

TEST_F(CommandLine, DecodeReadsLongCaptures) {
  std::string capture = "$timescale 1 us $end $var wire 1 ! rx $end $enddefinitions $end\n#0\n1!\n";
  for (int i = 1; i <= 120'000; ++i)
    capture += "#" + std::to_string(500 * i) + "\n" + std::to_string(i % 2) + "!\n";
  ASSERT_GT(capture.size(), 1U << 20U);
  write("long.vcd", capture);
  const Outcome o = program({"decode", "long.vcd"});
  EXPECT_EQ(o.code, 0);
  EXPECT_EQ(o.err, "");
}

TEST_F(CommandLine, DecodeRefusesCapturesThatMemoryCouldNotHold) {
  write("huge.vcd", "");
  std::filesystem::resize_file(path("huge.vcd"), (256U << 20U) + 1);
  expect_refused({"decode", "huge.vcd"}, 2,
                 "huge.vcd (longer than 256 MiB) shorten it or name a capture file");
}

}  // namespace
