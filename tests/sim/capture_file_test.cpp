// Which format a capture is of: by its ending, in any case, by its first bytes, and behind the mark
// that may stand before a text.
#include "sim/capture/capture_file.hpp"
#include "capture_lines.hpp"
#include "program.hpp"

namespace {

using sim::test::edges_us;
using sim::test::failure_of;

const std::string vcd_text =
    "$timescale 1 us $end $var wire 1 ! rx $end $enddefinitions $end #0 1! #5 0! #9 1! #20";
const std::string csv_text = "time_us,rx\n0,1\n5,0\n9,1\n20,1\n";
const std::string pulses = ";pulse data\n;timescale 1us\n4 1\n;end\n";
const std::string utf8 = "\xEF\xBB\xBF", utf16_le = "\xFF\xFE", utf16_be = "\xFE\xFF";

class CaptureFile : public CommandLine {
 protected:
  /// Lengths in us of the first pulse of 0: of texts above 4, however they say it.
  long pulse_us(const std::string& name, const std::string& text,
                const sim::CaptureSettings& settings = {}) const {
    std::ofstream(path(name), std::ios::binary) << text;
    const auto wires = sim::read_whole(*sim::open_capture(path(name), settings).logic);
    const auto edges = edges_us(wires.at(0).trace);
    return edges.at(1) - edges.at(0);
  }
  std::string refusal(const std::string& name, const std::string& text,
                      const sim::CaptureSettings& settings = {}) const {
    std::string message = failure_of([&] { pulse_us(name, text, settings); });
    const std::size_t at = message.find(path(name).string());
    return at == std::string::npos ? message
                                   : message.replace(at, path(name).string().size(), name);
  }
};

// Oscilloscopes write to file systems that have capitals alone.
TEST_F(CaptureFile, EndingsMayBeCapitals) {
  for (const char* name : {"x.vcd", "x.VCD", "x.Vcd"})
    EXPECT_EQ(pulse_us(name, vcd_text), 4) << name;
  for (const char* name : {"x.csv", "x.CSV", "x.Csv"})
    EXPECT_EQ(pulse_us(name, csv_text), 4) << name;
  EXPECT_EQ(pulse_us("x.OOK", pulses), 4);
  EXPECT_EQ(pulse_us("x.BIN", std::string("\1\1\0\0\1\1", 6), {"", dsp::Hertz(0.5e6), ""}), 4);
  const auto why = [&](const std::string& name) {
    const std::string message = refusal(name, "x");
    return message.substr(std::min(message.find('('), message.size()));
  };
  for (const std::string ending : {"SR sr", "WAV wav", "H5 h5", "SIGMF-META sigmf-meta"}) {
    const std::size_t blank = ending.find(' ');
    EXPECT_EQ(why("x." + ending.substr(0, blank)), why("x." + ending.substr(blank + 1))) << ending;
  }
}

TEST_F(CaptureFile, AMarkBeforeATextIsPassedOver) {
  EXPECT_EQ(pulse_us("x.vcd", utf8 + vcd_text), 4);
  EXPECT_EQ(pulse_us("x.csv", utf8 + csv_text), 4);
  EXPECT_EQ(pulse_us("x.ook", utf8 + pulses), 4);
  EXPECT_EQ(pulse_us("x", utf8 + vcd_text), 4);
  EXPECT_EQ(pulse_us("x", utf8 + pulses), 4);
  EXPECT_EQ(pulse_us("x", utf8 + csv_text, {"", {}, "csv"}), 4);
  // A pipe may give it byte by byte.
  write("x.csv", csv_text);
  const std::string decode = " | " COSYS_PROGRAM " decode - --baud 1000 --format csv";
  const std::string pipe = "(printf '\\357'; sleep 0.2; printf '\\273\\277'; cat x.csv)" + decode;
  EXPECT_EQ(tool("sh", {"-c", pipe}), tool("sh", {"-c", "cat x.csv" + decode}));
}

TEST_F(CaptureFile, Utf16IsRefusedByName) {
  for (const std::string& mark : {utf16_le, utf16_be}) {
    for (const char* name : {"x.vcd", "x.csv", "x.ook", "x", "x.txt"})
      EXPECT_EQ(refusal(name, mark + std::string("$\0t\0", 4)),
                std::string("cannot decode ") + name + " (it is UTF-16 text) save it as UTF-8");
    EXPECT_EQ(refusal("x.txt", mark, {"", {}, "csv"}),
              "cannot decode x.txt (it is UTF-16 text) save it as UTF-8");
  }
}

TEST_F(CaptureFile, SamplesHaveNoMark) {
  const sim::CaptureSettings at_1_mhz{"", dsp::Hertz(1e6), ""};
  const std::string light(4, '\0'), rest(3, '\1');
  for (const std::string& mark : {utf8, utf16_le, std::string("\xFF\xFF")})
    EXPECT_EQ(pulse_us("x.bin", mark + light + rest, at_1_mhz), mark == utf16_le ? 5 : 4);
}

TEST_F(CaptureFile, SamplesWithAHeadAreNoRawOnes) {
  for (const char* beginning : {"<SALEAE>", "AG10", "RG01"}) {
    write("t.bin", beginning + std::string(1000, '\1'));
    EXPECT_EQ(program({"decode", "t.bin", "--sample-rate", "1MHz"}).code, 2) << beginning;
    EXPECT_NE(program({"decode", "t.bin"}).err.find("export it as CSV"), std::string::npos);
  }
}

TEST_F(CaptureFile, WhatIsNearAFormatIsRefusedByName) {
  EXPECT_EQ(refusal("x.sigmf", "x"),
            "cannot decode x.sigmf (it is a SigMF archive) unpack it with tar -xf, and give the "
            ".sigmf-meta in it");
  EXPECT_EQ(refusal("X.SIGMF-COLLECTION", "x"),
            "cannot decode X.SIGMF-COLLECTION (it is a SigMF collection) give a .sigmf-meta that "
            "it names");
}

}  // namespace
