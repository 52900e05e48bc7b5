// Captures of samples: WAV and SigMF, of every kind that is read, and what is wrong with others.
#include <algorithm>

#include "capture_fixture.hpp"
#include "sim/capture/capture_units.hpp"
#include "sim/capture/text_lines.hpp"

namespace sim {
namespace {

using dsp::Hertz;
using test::failure_of;

std::string little_endian(std::uint64_t number, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(number >> (8 * i));
  return text;
}

/// 16 bits, two channels.
std::string as_wav(const std::vector<std::pair<int, int>>& frames) {
  std::string data;
  for (const auto& [left, right] : frames)
    data += little_endian(static_cast<std::uint16_t>(left), 2) +
            little_endian(static_cast<std::uint16_t>(right), 2);
  return "RIFF" + little_endian(36 + data.size(), 4) + "WAVEfmt " + little_endian(16, 4) +
         little_endian(1, 2) + little_endian(2, 2) + little_endian(192000, 4) +
         little_endian(768000, 4) + little_endian(4, 2) + little_endian(16, 2) + "data" +
         little_endian(data.size(), 4) + data;
}

std::vector<std::complex<float>> all_of(const Capture& capture) {
  std::vector<std::complex<float>> values;
  std::array<std::complex<float>, 3> block;
  while (const std::size_t n = capture.samples->read(block))
    values.insert(values.end(), block.begin(), block.begin() + static_cast<std::ptrdiff_t>(n));
  return values;
}

using Values = std::vector<std::complex<float>>;

TEST_F(CaptureFormat, WavGivesTheChannelAskedFor) {
  const std::string wav = as_wav({{16384, 1}, {-32768, 2}, {0, 3}, {8192, 4}});
  EXPECT_EQ(all_of(open(wav, "wav", "1")), (Values{0.5F, -1, 0, 0.25F}));
  EXPECT_EQ(all_of(open(wav, "wav", "2"))[3], std::complex<float>(4 / 32768.0F));
  EXPECT_EQ(open(wav, "").samples->sample_rate(), Hertz(192000));  // by its first bytes
  EXPECT_EQ(refusal(wav, "wav", "0"),
            "--wire 0 is not in FILE (the capture has no such wire) use 1 or 2");
}

// What a recorder that loses its power leaves: all samples, and a head that counts none.
TEST_F(CaptureFormat, WavWithoutASizeIsRefused) {
  std::string bytes = as_wav(std::vector<std::pair<int, int>>(4096, {1, 2}));
  const std::size_t data = bytes.find("data");
  bytes.replace(data + 4, 4, 4, '\0');
  bytes.replace(4, 4, 4, '\0');
  EXPECT_TRUE(
      refusal(bytes, "wav")
          .starts_with(
              "cannot decode FILE (its head says that no samples are there, of 16428 bytes) "))
      << refusal(bytes, "wav");
}

TEST_F(CaptureFormat, WavThatIsCutShortIsRefused) {
  const std::string wav = as_wav({{16384, 1}, {-32768, 2}, {0, 3}, {8192, 4}});
  for (std::size_t size = 8; size < wav.size(); ++size)
    EXPECT_EQ(refusal(wav.substr(0, size), "wav"), "cannot decode FILE (" + std::to_string(size) +
                                                       " of its 60 bytes are there) copy it again");
  for (std::size_t size = 0; size < 8; ++size)
    EXPECT_EQ(refusal(wav.substr(0, size), "wav").substr(0, 16), "cannot read FILE");
  // Who writes into a pipe cannot say how much it will be.
  const std::string endless(4, '\xff');
  const std::string piped = "RIFF" + endless + wav.substr(8, 32) + endless + wav.substr(44);
  EXPECT_EQ(all_of(open(piped, "wav")), (Values{0.5F, -1, 0, 0.25F}));
}

class Sigmf : public CaptureFormat {
 protected:
  Sigmf() : data_(path_.string() + ".sigmf-data") { path_ += ".sigmf-meta"; }
  ~Sigmf() override { std::filesystem::remove(data_); }

  Values values(const std::string& meta, const std::string& data,
                const std::string& wire = "") const {
    std::ofstream(data_, std::ios::binary) << data;
    return all_of(open(meta, "", wire));
  }
  static std::string meta(const std::string& type, const std::string& more = "",
                          const std::string& captures = "") {
    return R"({"global":{"core:version":"1.2.5","core:sample_rate":1e5,"core:datatype":")" + type +
           "\"" + more + R"(},"captures":[)" + captures + R"(],"annotations":[]})";
  }
  /// Why a recording is refused, and what is suggested.
  std::string why(const std::string& text) const {
    const std::string message = failure_of([&] { values(text, std::string(64, '\0')); });
    const std::string name = "cannot read " + path_.string() + " (";
    return message.starts_with(name) ? message.substr(name.size()) : message;
  }

  std::filesystem::path data_;
};

TEST_F(Sigmf, ReadsTheTypesOfTheStandard) {
  const std::string half = little_endian(0x3F000000, 4), one = little_endian(0x3F800000, 4);
  EXPECT_EQ(values(meta("rf32_le"), half + one), (Values{0.5F, 1}));
  EXPECT_EQ(values(meta("cf32_le"), half + one), (Values{{0.5F, 1}}));
  EXPECT_EQ(values(meta("cf32_le"), half + one + half), (Values{{0.5F, 1}}));  // cut short
  EXPECT_EQ(values(meta("ri16_be"), "\x01\x02\xff\xff"), (Values{258, -1}));
  EXPECT_EQ(values(meta("ri16_le"), "\x01\x02\xff\xff"), (Values{513, -1}));
  EXPECT_EQ(values(meta("cu8"), "\x01\xff"), (Values{{-127, 127}}));
  EXPECT_EQ(values(meta("ri8"), "\x01\xff"), (Values{1, -1}));
  EXPECT_EQ(values(meta("ru32_le"), little_endian(0x80000007, 4)), (Values{7}));
  EXPECT_EQ(values(meta("rf64_le"), little_endian(0x3FE0000000000000, 8)), (Values{0.5F}));
  EXPECT_EQ(values(meta("ri8", R"(,"core:num_channels":2)"), "\1\2\3\4", "2"), (Values{2, 4}));
}

TEST_F(Sigmf, SaysWhatIsWrong) {
  const auto problem = [&](const std::string& text) {
    return failure_of([&] { values(text, std::string(8, '\0')); });
  };
  const std::string give = ") give a SigMF recording, version 1";
  const std::string name = "cannot read " + path_.string() + " (";
  EXPECT_EQ(problem(meta("rf16_le")), name + "core:datatype 'rf16_le' is not one of SigMF" + give);
  EXPECT_EQ(problem(meta("ri8", R"(,"core:num_channels":0)")),
            name + "core:num_channels is not from 1 to 64" + give);
  for (const char* rate : {"1e-300", "0.9", "1.1e12", "1e300", "-1"})
    EXPECT_EQ(problem(meta("ri8", std::string(R"(,"core:sample_rate":)") + rate)),
              name + "core:sample_rate is not from 1 Hz to 1 THz) say --sample-rate");
  EXPECT_EQ(problem("{}").substr(0, name.size()), name);
  EXPECT_EQ(problem("[1").substr(0, name.size()), name);
  EXPECT_EQ(problem(R"({"global":{"core:datatype":5}})").substr(0, name.size()), name);
  EXPECT_EQ(failure_of([&] { values(meta("rf32_le"), std::string("\0\0\xc0\x7f", 4)); }),
            name + "a sample is not finite" + give);
  std::filesystem::remove(data_);
  EXPECT_EQ(failure_of([&] { open(meta("ri8"), ""); }),
            data_.string() + " (no such file) check the path");
}

// What stands for 0 is the middle: a signed recording of the same light is the same.
TEST_F(Sigmf, UnsignedTypesAreTheSignedOnesMovedToTheMiddle) {
  test::Random random(81);
  for (const auto& [sign, size] : std::vector<std::pair<const char*, int>>{
           {"8", 1}, {"16_le", 2}, {"16_be", 2}, {"32_le", 4}, {"32_be", 4}}) {
    const bool big = std::string_view(sign).ends_with("be");
    std::string offset, twos_complement;
    for (int i = 0; i < 200; ++i) {
      std::string number = little_endian(random(), size);
      if (big) std::ranges::reverse(number);
      offset += number;
      number[big ? 0 : number.size() - 1] ^= '\x80';
      twos_complement += number;
    }
    for (const std::string kind : {"r", "c"})
      EXPECT_EQ(values(meta(kind + "u" + sign), offset),
                values(meta(kind + "i" + sign), twos_complement))
          << kind << sign;
  }
}

TEST_F(Sigmf, BytesThatAreNoSamplesArePassedOver) {
  const std::string three = R"({"core:sample_start":0,"core:header_bytes":3})";
  EXPECT_EQ(values(meta("ri8", "", three), "xyz\1\2\3"), (Values{1, 2, 3}));
  EXPECT_EQ(values(meta("ri16_le", "", three), "xyz\1\2\3\4"), (Values{513, 1027}));
  EXPECT_EQ(values(meta("ri8", R"(,"core:trailing_bytes":2)", three), "xyz\1\2\3xy"),
            (Values{1, 2, 3}));
  EXPECT_EQ(values(meta("ri8", R"(,"core:trailing_bytes":20)"), "xyz"), Values{});
  EXPECT_EQ(values(meta("ri8", "", R"({"core:sample_start":0,"core:header_bytes":99999})"), "xyz"),
            Values{});
}

TEST_F(Sigmf, CapturesFollowEachOther) {
  const auto capture = [](int start, const std::string& more = "") {
    return R"({"core:sample_start":)" + std::to_string(start) + more + "}";
  };
  const std::string header = R"(,"core:header_bytes":2)";
  EXPECT_EQ(values(meta("ri8", "", capture(0) + "," + capture(2)), "\1\2\3"), (Values{1, 2, 3}));
  EXPECT_EQ(values(meta("ri8", "", capture(0, header) + "," + capture(2, header)), "xx\1\2yy\3"),
            (Values{1, 2, 3}));
  EXPECT_EQ(values(meta("ci8", "", capture(0) + "," + capture(1, header)), "\1\2yy\3\4"),
            (Values{{1, 2}, {3, 4}}));
  EXPECT_EQ(values(meta("ri8", R"(,"core:num_channels":2)", capture(0) + "," + capture(1, header)),
                   "\1\2yy\3\4"),
            (Values{1, 3}));
  // The first of several files of a recording, and a later one.
  EXPECT_EQ(values(meta("ri8", R"(,"core:offset":10)", capture(10) + "," + capture(11, header)),
                   "\1yy\2"),
            (Values{1, 2}));
  // One of no samples, and one behind the last.
  EXPECT_EQ(
      values(meta("ri8", "", capture(0, header) + "," + capture(0, header) + "," + capture(9)),
             "xxyy\1"),
      (Values{1}));
  // Whatever says nothing of the samples.
  EXPECT_EQ(values(meta("ri8", "",
                        capture(0, R"(,"core:datetime":"2026-11-25T10:00:00Z","x:y":1)") + "," +
                            capture(1, R"(,"core:datetime":"2026-11-25T10:00:01.5Z")")),
                   "\1\2"),
            (Values{1, 2}));
}

TEST_F(Sigmf, GapsAndMovesAreRefusedByName) {
  const auto refused = [&](const char* type, const std::string& first, const std::string& second) {
    return why(
        meta(type, "",
             R"({"core:sample_start":0,)" + first + R"(},{"core:sample_start":4,)" + second + "}"));
  };
  const std::string make = ") make a recording of each of its captures";
  EXPECT_EQ(refused("ri8", R"("core:global_index":100)", R"("core:global_index":104)"),
            "no failure");
  EXPECT_EQ(refused("ri8", R"("core:global_index":0)", R"("core:global_index":8)"),
            "core:global_index says that samples before 4 are missing" + make);
  EXPECT_EQ(refused("ri8", R"("x:y":0)", R"("core:global_index":8)"),
            "core:global_index says that samples before 4 are missing" + make);
  EXPECT_EQ(refused("ri8", R"("core:datetime":"2026-11-25T23:59:59Z")",
                    R"("core:datetime":"2026-11-26T00:00:05.25Z")"),
            "core:datetime says that time before sample 4 is missing" + make);
  EXPECT_EQ(refused("ci8", R"("core:frequency":1e6)", R"("core:frequency":2e6)"),
            "its core:frequency changes at sample 4" + make);
  EXPECT_EQ(refused("ri8", R"("core:frequency":1e6)", R"("core:frequency":2e6)"), "no failure");
}

TEST_F(Sigmf, WhatMayChangeTheMeaningIsRefusedByName) {
  const std::string give = ") give a SigMF recording, version 1";
  const auto global = [&](const std::string& field) { return why(meta("ri8", "," + field)); };
  EXPECT_EQ(global(R"("core:extensions":[{"name":"x","version":"1.0.0","optional":true}])"),
            "no failure");
  EXPECT_EQ(global(R"("core:extensions":[{"name":"x","version":"1.0.0","optional":false}])"),
            "its extension 'x' in core:extensions is not optional, and not known here" + give);
  EXPECT_EQ(global(R"("core:extensions":[{"name":"x"}])"),
            "its extension 'x' in core:extensions is not optional, and not known here" + give);
  EXPECT_EQ(global(R"("core:author":"x","x:scale":2,"core:hw":"y")"), "no failure");
  EXPECT_EQ(global(R"("core:scale":2)"),
            "its core:scale is not known here, and may say how samples are to be read" + give);
  EXPECT_EQ(
      why(meta("ri8", "", R"({"core:sample_start":0,"core:sample_rate":5})")),
      "its core:sample_rate is not known here, and may say how samples are to be read" + give);
  EXPECT_EQ(global(R"("core:version":"2.0.0")"), "its core:version is 2.0.0" + give);
  EXPECT_EQ(global(R"("core:version":"v0.0.2")"), "no failure");
  EXPECT_EQ(global(R"("core:metadata_only":true)"),
            "core:metadata_only says that its samples are not there) give it with its samples");
  EXPECT_EQ(global(R"("core:metadata_only":false)"), "no failure");
  EXPECT_EQ(global(R"("core:dataset":"../x")"),
            "core:dataset is not the name of a file beside it" + give);
  EXPECT_EQ(global(R"("core:trailing_bytes":-1)"), "core:trailing_bytes is no count" + give);
  EXPECT_EQ(global(R"("x:y":1e999)"), "it has a number that no computer has room for" + give);
  EXPECT_EQ(global(R"("core:offset":1)"), "no failure");  // there are no captures
  EXPECT_EQ(why(meta("ri8", R"(,"core:offset":1)", R"({"core:sample_start":0})")),
            "a core:sample_start is before core:offset" + give);
  EXPECT_EQ(why(meta("ri8", "", R"({"core:sample_start":5},{"core:sample_start":4})")),
            "its captures are not in the order of core:sample_start" + give);
  EXPECT_EQ(why(meta("ri8", "", "{}")), "a capture has no core:sample_start" + give);
  EXPECT_EQ(why(meta("ri8", "", R"({"core:sample_start":1.5})")),
            "core:sample_start is no count" + give);
  EXPECT_EQ(why(R"({"global":{"core:datatype":"ri8"}})"),
            "it has no core:sample_rate) say --sample-rate");
}

TEST_F(Sigmf, EitherFileMayBeGivenAndTheirNamesMayBeCapitals) {
  const auto read = [](const std::filesystem::path& path) {
    return all_of(open_capture(path, {}));
  };
  values(meta("ri8"), "\1\2");
  EXPECT_EQ(read(data_), (Values{1, 2}));
  const std::filesystem::path folder = path_.string() + ".d";
  std::filesystem::create_directory(folder);
  std::ofstream(folder / "X.SIGMF-META") << "\xEF\xBB\xBF" << meta("ri8");
  std::ofstream(folder / "X.SIGMF-DATA") << "\3\4";
  EXPECT_EQ(read(folder / "X.SIGMF-META"), (Values{3, 4}));
  EXPECT_EQ(read(folder / "X.SIGMF-DATA"), (Values{3, 4}));
  std::ofstream(folder / "y.sigmf-meta") << meta("ri8", R"(,"core:dataset":"y.wav")");
  std::ofstream(folder / "y.wav") << "\5";
  EXPECT_EQ(read(folder / "y.sigmf-meta"), (Values{5}));
  std::filesystem::remove_all(folder);
  EXPECT_EQ(why("\xFF\xFE{"),
            "cannot decode " + path_.string() + " (it is UTF-16 text) save it as UTF-8");
}

TEST(SampleRate, IsReadWithItsUnit) {
  EXPECT_EQ(parse_sample_rate("1 MHz"), Hertz(1e6));
  EXPECT_EQ(parse_sample_rate("44.1 kHz"), Hertz(44.1e3));
  EXPECT_EQ(parse_sample_rate("96000"), Hertz(96000));
  EXPECT_EQ(parse_sample_rate("2 GHz"), Hertz(2e9));
  EXPECT_EQ(parse_sample_rate("3k"), Hertz(3e3));
  EXPECT_EQ(parse_sample_rate("1 M"), Hertz(1e6));
  for (const char* wrong : {"", "Hz", "-1", "0", "1 mHz", "1 m", "1 kk", "inf", "1e999", "nan kHz",
                            "0.9", "1000.1 GHz"})
    EXPECT_EQ(parse_sample_rate(wrong), std::nullopt) << wrong;
}

}  // namespace
}  // namespace sim
