// encode and decode from outside: formats, and how long a capture may be.
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "protocol/shared_link.hpp"
#include "sim/trace/vcd.hpp"

namespace {

const std::string vector_of_the_protocol = "AB|N0|D40.12345678|D-113.12345678|D85.6|D22.1";

/// A capture of a wire that carries these bytes at 600 Bd.
void write_capture(const std::filesystem::path& path, const std::string& bytes) {
  dsp::LogicTrace line(true);
  dsp::Seconds at(0.01);
  for (const char byte : bytes)
    at = protocol::send_byte(line, static_cast<std::uint8_t>(byte), at, dsp::Hertz(600));
  std::ofstream out(path);
  sim::write_vcd(out, std::vector<sim::VcdWire>{{"rx", &line}}, at + dsp::Seconds(0.01));
}

TEST_F(CommandLine, EncodesEveryFormat) {
  EXPECT_EQ(program({"encode", "IND 011111 OK"}).out, "IND 011111 OK 46\n");
  EXPECT_EQ(program({"encode", "--protocol", "cosys", "IND 011111 OK"}).out, "IND 011111 OK 46\n");
  EXPECT_EQ(program({"encode", "--protocol", "sharedlink", vector_of_the_protocol}).out,
            "[:AB|N0|D40.12345678|D-113.12345678|D85.6|D22.1|CD4]\r\n");
  EXPECT_EQ(program({"encode", "--protocol", "sharedlink", "BA"}).out, "[:BA|C7C]\r\n");
}

TEST_F(CommandLine, EncodeRefusesWhatCannotBeSent) {
  const auto refused = [&](const std::string& message, const std::string& why) {
    expect_refused({"encode", "--protocol", "sharedlink", message}, 2,
                   "the message cannot be sent (" + why +
                       ") write it from its addresses on, such as 'AB|N0|D40.1|D85.6'");
  };
  refused("", "it does not begin with two addresses and a |");
  refused("ABC", "it does not begin with two addresses and a |");
  refused("AQ|D1", "'Q' is no address, 'A' to 'P'");
  refused("AB|X1", "field \"X1\" does not begin with one of the letters NDQR");
  refused("AB||D1", "field \"\" does not begin with one of the letters NDQR");
  refused("AB|D1]", "']' at position 1 belongs to the format");
  refused("AB|D" + std::string(250, '1'), "it would be 263 bytes long, 7 over the limit of 256");
  expect_refused({"encode", "--protocol", "morse", "x"}, 2,
                 "--protocol: morse not in {cosys,sharedlink} (wrong usage) see cosys-sim encode "
                 "--help");
}

TEST_F(CommandLine, DecodesSharedLink) {
  const std::string whole =
      program({"encode", "--protocol", "sharedlink", vector_of_the_protocol}).out;
  std::string wrong = whole;
  wrong[9] = '9';
  write_capture(path("t.vcd"), whole + wrong + "[:AB|N0|D4");
  const Words decode{"decode", "t.vcd", "--protocol", "sharedlink", "--uart", "mid-bit"};
  EXPECT_EQ(program(decode).out,
            "   0.010000 s  ok              AB|N0|D40.12345678|D-113.12345678|D85.6|D22.1\n"
            "   0.910000 s  wrong_checksum  :AB|N0|D90.12345678|D-113.12345678|D85.6|D22.1|CD4\n"
            "          end  no bracket      :AB|N0|D4\n");
  Words json = decode;
  json.emplace_back("--json");
  std::istringstream lines(program(json).out);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(nlohmann::json::parse(line)["message"], vector_of_the_protocol);
  std::getline(lines, line);
  EXPECT_EQ(nlohmann::json::parse(line)["outcome"], "wrong_checksum");
  EXPECT_NEAR(nlohmann::json::parse(line)["time_s"].get<double>(), 0.91, 1e-4);
  std::getline(lines, line);
  EXPECT_EQ(nlohmann::json::parse(line),
            (nlohmann::json{{"outcome", "no bracket"}, {"message", ":AB|N0|D4"}}));
  EXPECT_EQ(program({"decode", "t.vcd"}).out.find(" ok "), std::string::npos);
}

TEST_F(CommandLine, DecodeReadsLongCaptures) {
  std::string capture = "$timescale 1 us $end $var wire 1 ! rx $end $enddefinitions $end\n#0\n1!\n";
  for (int i = 1; i <= 120'000; ++i)
    capture += "#" + std::to_string(500 * i) + "\n" + std::to_string(i % 2) + "!\n";
  ASSERT_GT(capture.size(), 1U << 20U);
  write("long.vcd", capture);
  const Outcome o = program({"decode", "long.vcd"});
  EXPECT_EQ(o.code, 0);
  EXPECT_EQ(o.err, "cosys-sim: no cosys message in 0 characters\n");
}

TEST_F(CommandLine, DecodeRefusesCapturesThatMemoryCouldNotHold) {
  write("huge.vcd", "");
  std::filesystem::resize_file(path("huge.vcd"), (256U << 20U) + 1);
  expect_refused({"decode", "huge.vcd"}, 2,
                 "huge.vcd (longer than 256 MiB) shorten it or name a capture file");
}

}  // namespace
