// encode and decode from outside: formats, and how long a capture may be.
#include <fmt/format.h>
#include <sys/stat.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "decoded_line.hpp"
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

/// What decode prints between its first line and its table of the line.
std::string frames_of(const std::string& out) {
  const std::size_t begin = out.find('\n') + 1;
  return out.substr(begin, out.find("\n\n") + 1 - begin);
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
  EXPECT_EQ(frames_of(program(decode).out),
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
            (nlohmann::json{
                {"format_version", "1"}, {"outcome", "no bracket"}, {"message", ":AB|N0|D4"}}));
  EXPECT_EQ(program({"decode", "t.vcd"}).out.find(" ok "), std::string::npos);
}

TEST_F(CommandLine, DecodeReadsLongCaptures) {
  std::string capture = "$timescale 1 us $end $var wire 1 ! rx $end $enddefinitions $end\n#0\n1!\n";
  for (int i = 1; i <= 120'000; ++i)
    capture += "#" + std::to_string(500 * i) + "\n" + std::to_string(i % 2) + "!\n";
  capture += "#60001000\n";
  ASSERT_GT(capture.size(), 1U << 20U);
  write("long.vcd", capture);
  const Outcome o = program({"decode", "long.vcd", "--baud", "600"});
  EXPECT_EQ(o.code, 0);
  EXPECT_EQ(o.err, "cosys-sim: no cosys message in 0 characters\n");
}

/// Bytes as one bit a sample, bit 0 of a byte.
std::string sampled_wire(const dsp::LogicTrace& line, double rate, bool inverted) {
  std::string samples;
  dsp::TraceReader reader(line);
  for (double i = 0; i / rate < line.end().value; ++i)
    samples += static_cast<char>(reader.level_at(dsp::Seconds(i / rate)) != inverted);
  return samples;
}

TEST_F(CommandLine, DecodeFindsPolarityAndBaud) {
  write("t.bin", sampled_wire(message_line(2400 * 1.004), 1e6, true));
  const Words decode{"decode", "t.bin", "--sample-rate", "1e6", "--uart", "mid-bit"};
  const Outcome o = program(decode);
  EXPECT_EQ(frames_of(o.out), its_message) << o.err;
  for (const char* row : {"polarity                idle-low\n", "characters              17\n",
                          "framing errors          0\n", "baud                    2400\n"})
    EXPECT_NE(o.out.find(row), std::string::npos) << row << o.out;
  Words json = decode;
  json.emplace_back("--json");
  const auto facts = line_facts(program(json).out);
  EXPECT_NEAR(facts.at("baud_error_ppm").get<double>(), 4000, 50);
  EXPECT_LT(facts.at("jitter_us_rms").get<double>(), 1);
  EXPECT_LT(std::abs(facts.at("pulse_width_distortion_us").get<double>()), 1);
  Words told = decode;
  told.insert(told.end(), {"--polarity", "idle-high"});
  EXPECT_EQ(program(told).out.find(" ok "), std::string::npos);
}

TEST_F(CommandLine, DecodeReadsMoreChannelsThanAByteHas) {
  const std::string one = sampled_wire(message_line(600), 1e5, false);
  std::string samples;
  for (const char level : one) samples += std::string("\x5a") + static_cast<char>(level << 3);
  write("wide.bin", samples);
  const Words decode{"decode", "wide.bin", "--sample-rate", "1e5", "--uart", "mid-bit"};
  Words wide = decode;
  wide.insert(wide.end(), {"--sample-bytes", "2", "--wire", "11"});
  EXPECT_EQ(frames_of(program(wide).out), its_message);
  wide.back() = "16";
  expect_refused(wide, 2,
                 "--wire 16 is not in wide.bin (the capture has no such wire) use 0 or 1 or 2 or 3 "
                 "or 4 or 5 or "
                 "6 or 7 or 8 or 9 or 10 or 11 or 12 or 13 or 14 or 15");
  const Outcome narrow = program(decode);
  EXPECT_EQ(narrow.code, 4) << "a byte a sample is not what it has";
  EXPECT_EQ(narrow.err,
            "cosys-sim: its bytes repeat every 2 (it may have 2 a sample) say --sample-bytes 2, or "
            "1\n");
  write_capture(path("t.vcd"), "IND 011111 OK 46\n");
  expect_refused(
      {"decode", "t.vcd", "--sample-bytes", "2"}, 2,
      "--sample-bytes is not for t.vcd (its format says that itself, or has none) leave it "
      "out");
}

TEST_F(CommandLine, DecodeFindsNoLineInNoise) {
  write_scenario("s.toml", "receiver.range_m = [60]");
  ASSERT_EQ(program({"trace", "s.toml", "-o", "t.wav"}).code, 0);
  const Outcome o = program({"decode", "t.wav"});
  EXPECT_EQ(o.code, 4) << o.out;
  EXPECT_NE(o.err.find("cosys-sim: no line is found ("), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("say --baud or --channel\n"), std::string::npos) << o.err;
  EXPECT_EQ(program({"decode", "t.wav", "--baud", "600"}).code, 0) << "as told";
}

TEST_F(CommandLine, DecodeReadsPulsesThatTakeNoTime) {
  write("t.ook", ";pulse data\n0 0\n;end\n");
  EXPECT_EQ(program({"decode", "t.ook"}).code, 0);
}

TEST_F(CommandLine, DecodeReadsTheWireOfAnLed) {
  std::string samples = sampled_wire(message_line(600), 1e6, false);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double turns = static_cast<double>(i) * 59e3 / 1e6;
    samples[i] = static_cast<char>(samples[i] == 0 && turns - std::floor(turns) < 0.5);
  }
  write("led.bin", samples);
  const Words decode{"decode", "led.bin", "--sample-rate", "1e6", "--json"};
  const Outcome o = program(decode);
  EXPECT_NE(o.out.find(R"("IND 011111 OK","outcome":"ok")"), std::string::npos) << o.out << o.err;
  EXPECT_NEAR(line_facts(o.out).at("carrier_hz").get<double>(), 59e3, 100);
  EXPECT_EQ(line_facts(o.out).at("polarity"), "idle-high");
  Words without = decode;
  without.insert(without.end(), {"--carrier", "0"});
  EXPECT_EQ(program(without).out.find(R"("ok")"), std::string::npos);
}

TEST_F(CommandLine, DecodeReadsPipesByWhatTheyBeginWith) {
  write_capture(path("t.vcd"), "IND 011111 OK 46\n");
  const std::string decode = std::string(COSYS_PROGRAM) + " decode /dev/stdin";
  EXPECT_NE(tool("sh", {"-c", "cat t.vcd | " + decode}).find(" ok "), std::string::npos);
  EXPECT_NE(
      tool("sh", {"-c", "cat t.vcd | " + std::string(COSYS_PROGRAM) + " decode -"}).find(" ok "),
      std::string::npos);
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  expect_refused({"decode", "pipe"}, 2,
                 "cannot decode pipe (nothing is in it) of a pipe, start the writer first");
  write("t.bin", sampled_wire(message_line(600), 1e5, false));
  EXPECT_NE(
      tool("sh", {"-c", "cat t.bin | " + decode + " --format bin --sample-rate 1e5"}).find(" ok "),
      std::string::npos);
}

TEST_F(CommandLine, DecodeSaysWhatAPipeCannotBe) {
  write_scenario("s.toml", "receiver.range_m = [0.5]");
  for (const char* file : {"t.sr", "t.wav"})
    ASSERT_EQ(program({"trace", "s.toml", "-o", file}).code, 0);
  const auto piped = [&](const std::string& file, const std::string& options) {
    return start_tool("sh", {"-c", "cat " + file + " | " + COSYS_PROGRAM + " decode - " + options})
        .finish();
  };
  EXPECT_EQ(piped("t.sr", "").err,
            "cosys-sim: cannot decode /dev/stdin (a .sr cannot be read from a pipe) give a file\n");
  EXPECT_EQ(piped("t.wav", "").err,
            "cosys-sim: cannot decode /dev/stdin (its beginning was read to tell its format) say "
            "--format wav\n");
  EXPECT_EQ(piped("t.wav", "--format wav").code, 0);
}

TEST_F(CommandLine, MeasuredDecodeSaysThatItWaitsForAPipe) {
  write_capture(path("t.vcd"), "IND 011111 OK 46\n");
  const Outcome o =
      start_tool("sh", {"-c", "(sleep 8; cat t.vcd) | " + std::string(COSYS_PROGRAM) + " decode -"})
          .finish();
  EXPECT_NE(o.out.find(" ok "), std::string::npos);
  EXPECT_EQ(o.err,
            "cosys-sim: waiting for /dev/stdin (a pipe or device, and nothing has come for 5 s)\n");
}

TEST_F(CommandLine, DecodeReadsTheLightOfATrace) {
  write_scenario("s.toml", "receiver.range_m = [0.5]");
  ASSERT_EQ(program({"trace", "s.toml", "-o", "t.csv"}).code, 0);
  const Words decode{"decode", "t.csv", "--json", "--channel", "irradiance_mw_per_m2"};
  const Outcome o = program(decode);
  EXPECT_NE(o.out.find(R"("IND 011111 OK","outcome":"ok")"), std::string::npos) << o.out << o.err;
  EXPECT_NEAR(line_facts(o.out).at("carrier_hz").get<double>(), 59e3, 100);
  Words told = decode;
  told.insert(told.end(), {"--carrier", "38000"});
  EXPECT_EQ(program(told).out.find(R"("ok")"), std::string::npos);
}

TEST_F(CommandLine, DecodeReadsMoreThanMemoryMayHold) {
  write("huge.bin", sampled_wire(message_line(600), 1e6, false));
  std::ofstream(path("huge.bin"), std::ios::app) << std::string(1000, '\1');
  std::filesystem::resize_file(path("huge.bin"), 200U << 20U);  // a break that never ends
  const Outcome o = program({"decode", "huge.bin", "--sample-rate", "1e6", "--uart", "mid-bit",
                             "--polarity", "idle-high"});
  EXPECT_EQ(frames_of(o.out), its_message + "          end  no newline      \\x00\n") << o.err;
  EXPECT_LT(o.peak_kb, 100 * 1024);
}

TEST_F(CommandLine, MeasuredDecodeRefusesMoreVariablesThanMemoryMayHold) {
  for (const std::string& name : {std::string("x"), std::string(4000, 'x')}) {
    std::ofstream out(path("many.vcd"));
    out << "$timescale 1 us $end\n";
    for (std::size_t i = 0; i * name.size() < 100'000'000 && i < 1'000'000; ++i)
      out << "$var wire 1 " << i << name << " x $end\n";
    out << "$enddefinitions $end\n";
    out.close();
    const Outcome o = program({"decode", "many.vcd"});
    EXPECT_EQ(o.code, 2);
    EXPECT_NE(o.err.find("cosys-sim: too many variables in many.vcd:"), std::string::npos) << o.err;
    EXPECT_LT(o.peak_kb, 120 * 1024);
  }
}

TEST_F(CommandLine, MeasuredDecodeReadsAsManyEdgesAsThereAre) {
  std::ofstream out(path("many.ook"));
  out << ";pulse data\n;version 1\n;timescale 1us\n";
  for (int i = 0; i < 1'000'000; ++i) out << "60 40\n";  // too short for any character
  out.close();
  const Outcome o = program({"decode", "many.ook", "--baud", "600"});
  EXPECT_EQ(o.code, 0);
  EXPECT_LT(o.peak_kb, 100 * 1024);
}

}  // namespace
