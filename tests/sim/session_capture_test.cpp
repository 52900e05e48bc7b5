// sigrok's sessions: whatever GLib takes for a key file says what their samples are.
#include "capture_fixture.hpp"

namespace sim {
namespace {

using dsp::Hertz;
using test::edges_us;

std::string little_endian(std::uint64_t number, int bytes) {
  std::string text;
  for (; bytes > 0; --bytes, number >>= 8U) text += static_cast<char>(number & 0xFFU);
  return text;
}

std::uint32_t crc32_of(const std::string& bytes) {
  std::uint32_t crc = ~0U;
  for (const char byte : bytes) {
    crc ^= static_cast<std::uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1U ^ (crc & 1U ? 0xEDB88320U : 0U);
  }
  return ~crc;
}

using Members = std::vector<std::pair<std::string, std::string>>;

/// Members that are stored as they are (PKWARE's APPNOTE 6.3).
std::string as_zip(const Members& members) {
  std::string local, central;
  for (const auto& [name, bytes] : members) {
    const std::string facts = little_endian(20, 2) + little_endian(0, 8) +
                              little_endian(crc32_of(bytes), 4) + little_endian(bytes.size(), 4) +
                              little_endian(bytes.size(), 4) + little_endian(name.size(), 2) +
                              little_endian(0, 2);
    central += "PK\1\2" + little_endian(20, 2) + facts + little_endian(0, 10) +
               little_endian(local.size(), 4) + name;
    local += "PK\3\4" + facts + name + bytes;
  }
  const std::string count = little_endian(members.size(), 2);
  return local + central + "PK\5\6" + little_endian(0, 4) + count + count +
         little_endian(central.size(), 4) + little_endian(local.size(), 4) + little_endian(0, 2);
}

const std::string levels("\1\1\0\0\1", 5);

std::string session(const std::string& metadata, const std::string& bytes = levels) {
  return as_zip({{"version", "2"}, {"metadata", metadata}, {"logic-1-1", bytes}});
}

class SessionCapture : public CaptureFormat {
 protected:
  /// Each wire with its edges, in us.
  std::string read(const std::string& session) const {
    std::string text;
    for (const NamedTrace& wire : wires(session, "sr")) {
      text += wire.name + ":";
      for (const long edge : edges_us(wire.trace)) text += " " + std::to_string(edge);
      text += ";";
    }
    return text;
  }
};

TEST_F(SessionCapture, MetadataAreAKeyFile) {
  const std::string good = "rx: 2000 4000;";
  for (const char* metadata :
       {"[device 1]\nsamplerate=1 kHz\nprobe1=rx\nunitsize=1\ncapturefile=logic-1\n",
        "[device 1]\ncapturefile = logic-1\nunitsize = 1\ntotal probes = 1\nsamplerate = 1 kHz\n"
        "probe1 = rx\n",
        "[global]\r\nsigrok version = 0.2.1\r\n\r\n[device 1]\r\nsamplerate\t=\t1000\r\n"
        "  probe1=  rx  \r\n  unitsize =1",
        "# probe1=no\n[device 1]\n#samplerate=5\nprobe1=rx\n# unitsize=2\nsamplerate=1k\n",
        "[device 1]\nprobe1=other\nsamplerate=2 MHz\nprobe1=rx\nsamplerate=1000 Hz\nno key\n",
        "[device 1]\nprobe1=rx\n[global]\nsamplerate=5\n[device 1]\nsamplerate=0.001 MHz\n"})
    EXPECT_EQ(read(session(metadata)), good) << metadata;
  EXPECT_EQ(read(session("[device 1]\nsamplerate=1 kHz\nprobe1=a\\sb\\\\c\\d\n")),
            "a b\\c\\d: 2000 4000;");
}

TEST_F(SessionCapture, AMemberAloneIsAsGoodAsChunks) {
  const std::string metadata = "[device 1]\ncapturefile=logic-1\nsamplerate=1 kHz\nprobe1=rx\n";
  const std::string good = "rx: 2000 4000;";
  EXPECT_EQ(read(as_zip({{"version", "1"}, {"metadata", metadata}, {"logic-1", levels}})), good);
  EXPECT_EQ(read(as_zip({{"logic-1-2", levels.substr(3)},
                         {"metadata", metadata},
                         {"logic-1-1", levels.substr(0, 3)}})),
            good);
}

TEST_F(SessionCapture, TheFirstDeviceWithSamplesIsRead) {
  const std::string metadata =
      "[device 1]\ndriver=demo\nprobe1=no\nsamplerate=7\n"
      "[device 2]\ncapturefile=logic-1\nprobe1=rx\nsamplerate=1 kHz\n"
      "[device 3]\ncapturefile=logic-2\nprobe1=third\nsamplerate=9\n";
  EXPECT_EQ(read(session(metadata)), "rx: 2000 4000;");
}

TEST_F(SessionCapture, ChannelsWithoutANameAreNotUsed) {
  const std::string head = "[device 1]\ncapturefile=logic-1\nsamplerate=1 kHz\ntotal probes=8\n";
  EXPECT_EQ(
      read(session(head + "probe1=\nprobe3=rx\nprobe4=\nprobe8=tx\n", "\xFF\x7F\x7B\x02\x84\x84")),
      "rx: 2000 4000;tx: 1000 4000;");
}

TEST_F(SessionCapture, UnitsMayBeLargerThanNeeded) {
  const std::string head = "[device 1]\ncapturefile=logic-1\nsamplerate=1 kHz\nprobe2=rx\n";
  for (const std::size_t size : {1U, 2U, 3U, 8U, 9U, 16U}) {
    std::string bytes;
    for (const char level : levels)
      bytes +=
          static_cast<char>(2 * level) + std::string(size - 1, static_cast<char>(bytes.size()));
    const std::string said = "unitsize=" + std::to_string(size) + "\n";
    const std::string channels = "total probes=" + std::to_string(8 * size) + "\n";
    EXPECT_EQ(read(session(head + said, bytes)), "rx: 2000 4000;") << size;
    EXPECT_EQ(read(session(head + channels, bytes)), "rx: 2000 4000;") << size;
  }
}

TEST_F(SessionCapture, AnalogueChannelsAreNumberedBehindTheLogicOnes) {
  const std::string half = little_endian(0x3F000000, 4), one = little_endian(0x3F800000, 4);
  const std::string bytes =
      as_zip({{"metadata",
               "[device 1]\nanalog3 = ir\nanalog2 =\ntotal analog = 2\ncapturefile = logic-1\n"
               "samplerate = 1 kHz\nprobe1 = rx\n"},
              {"logic-1-1", levels},
              {"analog-1-3-1", half + one}});
  const Capture capture = open(bytes, "sr", "ir");
  std::array<std::complex<float>, 3> block;
  ASSERT_EQ(capture.samples->read(block), 2U);
  EXPECT_EQ(block[0], std::complex<float>(0.5F));
  EXPECT_EQ(capture.samples->sample_rate(), Hertz(1000));
  EXPECT_EQ(read(bytes), "rx: 2000 4000;");
}

TEST_F(SessionCapture, SaysWhatIsMissing) {
  const auto why = [&](const std::string& bytes) {
    const std::string message = refusal(bytes, "sr"), head = "cannot read FILE (";
    EXPECT_TRUE(message.starts_with(head)) << message;
    return message.substr(std::min(head.size(), message.size()));
  };
  const std::string give = ") give a session as sigrok or PulseView save it";
  const std::string device = "[device 1]\nprobe1=rx\nsamplerate=1 kHz\n";
  EXPECT_EQ(why(as_zip({{"version", "2"}})), "it has no member metadata" + give);
  EXPECT_EQ(why(as_zip({{"version", "3"}, {"metadata", device}})),
            "its version is neither 1 nor 2" + give);
  EXPECT_EQ(why(session("[global]\nsigrok version=0.5\n")), "its metadata have no device" + give);
  const std::string metadata = device + "capturefile=logic-1\n";
  const auto with = [&](const std::vector<std::string>& chunks) {
    Members members{{"version", "2"}, {"metadata", metadata}};
    for (const std::string& chunk : chunks) members.emplace_back(chunk, levels);
    return as_zip(members);
  };
  EXPECT_EQ(why(with({"logic-1-1", "logic-1-3"})),
            "its members logic-1-1, logic-1-2, ... have 3 where 2 must be" + give);
  EXPECT_EQ(why(with({"logic-1-0", "logic-1-1"})),
            "its members logic-1-1, logic-1-2, ... have 0 where 1 must be" + give);
  EXPECT_EQ(why(with({"logic-1", "logic-1-1"})), "it has both logic-1 and logic-1-1" + give);
  EXPECT_EQ(why(session("[device 1]\nprobe1=rx\n")),
            "its metadata have no samplerate of 1 Hz to 1 THz) say --sample-rate");
  EXPECT_EQ(why(session(device + "capturefile=logic-2\n")), "it has no member logic-2" + give);
  EXPECT_EQ(why(session(device + "probe9=tx\nunitsize=1\n")),
            "its unitsize does not fit its channels" + give);
  EXPECT_EQ(why(session(device + "unitsize=x\n")), "its unitsize does not fit its channels" + give);
  EXPECT_EQ(why(session(device + "probe65=tx\n")), "it has more than 64 logic channels" + give);
  EXPECT_EQ(why(session(device + std::string(65536, '#'))), "its metadata are over 64 KiB" + give);
}

}  // namespace
}  // namespace sim
