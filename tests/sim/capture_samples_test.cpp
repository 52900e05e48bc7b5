// Captures of samples: WAV and SigMF, of every kind that is read, and what is wrong with others.
#include "capture_fixture.hpp"
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
  EXPECT_EQ(all_of(open(wav, "wav")), (Values{0.5F, -1, 0, 0.25F}));
  EXPECT_EQ(all_of(open(wav, "wav", "1"))[3], std::complex<float>(4 / 32768.0F));
  EXPECT_EQ(open(wav, "").samples->sample_rate(), Hertz(192000));  // by its first bytes
  EXPECT_EQ(refusal(wav, "wav", "2"),
            "--channel 2 is not in FILE (channels of a WAV file are numbers from 0 on) use one up "
            "to 1");
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
  static std::string meta(const std::string& type, const std::string& more = "") {
    return R"({"global":{"core:version":"1.2.5","core:sample_rate":1e5,"core:datatype":")" + type +
           "\"" + more + R"(},"captures":[],"annotations":[]})";
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
  EXPECT_EQ(values(meta("cu8"), "\x01\xff"), (Values{{1, 255}}));
  EXPECT_EQ(values(meta("ri8"), "\x01\xff"), (Values{1, -1}));
  EXPECT_EQ(values(meta("ru32_le"), little_endian(7, 4)), (Values{7}));
  EXPECT_EQ(values(meta("rf64_le"), little_endian(0x3FE0000000000000, 8)), (Values{0.5F}));
  EXPECT_EQ(values(meta("ri8", R"(,"core:num_channels":2)"), "\1\2\3\4", "1"), (Values{2, 4}));
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
              name + "core:sample_rate is not from 1 Hz to 1 THz" + give);
  EXPECT_EQ(problem("{}").substr(0, name.size()), name);
  EXPECT_EQ(problem("[1").substr(0, name.size()), name);
  EXPECT_EQ(problem(R"({"global":{"core:datatype":5}})").substr(0, name.size()), name);
  EXPECT_EQ(failure_of([&] { values(meta("rf32_le"), std::string("\0\0\xc0\x7f", 4)); }),
            name + "a sample is not finite" + give);
  std::filesystem::remove(data_);
  EXPECT_EQ(failure_of([&] { open(meta("ri8"), ""); }),
            data_.string() + " (no such file) check the path");
}

TEST(SampleRate, IsReadWithItsUnit) {
  EXPECT_EQ(parse_sample_rate("1 MHz"), Hertz(1e6));
  EXPECT_EQ(parse_sample_rate("44.1 kHz"), Hertz(44.1e3));
  EXPECT_EQ(parse_sample_rate("96000"), Hertz(96000));
  EXPECT_EQ(parse_sample_rate("2 GHz"), Hertz(2e9));
  EXPECT_EQ(parse_sample_rate("3k"), Hertz(3e3));
  EXPECT_EQ(parse_sample_rate("1 M"), Hertz(1e6));
  for (const char* wrong :
       {"", "Hz", "-1", "0", "1 mHz", "1 m", "1 kk", "inf", "1e999", "nan kHz", "0.9", "1000.1 GHz"})
    EXPECT_EQ(parse_sample_rate(wrong), std::nullopt) << wrong;
}

}  // namespace
}  // namespace sim
