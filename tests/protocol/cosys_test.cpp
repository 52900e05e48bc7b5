#include "protocol/cosys.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "lines.hpp"
#include "protocol/uart_receivers.hpp"

namespace protocol {
namespace {

using dsp::Seconds;
using test::baud;
using test::Random;

/// All frames of a stream; byte number i starts at i seconds.
std::vector<CosysFrame> decode(CosysDecoder& decoder, std::string_view stream) {
  std::vector<CosysFrame> frames;
  double t = 0;
  for (const char c : stream) {
    if (auto frame = decoder.push({Seconds(t++), static_cast<std::uint8_t>(c), false})) {
      frames.push_back(std::move(*frame));
    }
  }
  return frames;
}

std::vector<CosysFrame> decode(std::string_view stream) {
  CosysDecoder decoder;
  return decode(decoder, stream);
}

std::string text(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

std::string random_text(Random& random, std::size_t longest) {
  std::string message(random() % (longest + 1), ' ');
  for (char& c : message) c = static_cast<char>(' ' + random() % 95);
  return message;
}

CosysOutcome outcome_of(std::string_view line) {
  const auto frames = decode(line);
  EXPECT_EQ(frames.size(), 1U) << line;
  return frames.empty() ? CosysOutcome::ok : frames[0].outcome;
}

TEST(Cosys, VectorsOfTheProtocol) {
  EXPECT_EQ(cosys_checksum("IND 011111 OK"), 0x46);
  EXPECT_EQ(cosys_checksum("RFID S:U"), 0x05);
  EXPECT_EQ(cosys_checksum(""), 0x00);
  EXPECT_EQ(text(cosys_encode("IND 011111 OK")), "IND 011111 OK 46\n");
  EXPECT_EQ(text(cosys_encode("RFID S:U")), "RFID S:U 05\n");
  EXPECT_EQ(text(cosys_encode("")), " 00\n");
  EXPECT_EQ(text(cosys_encode("j")), "j 6a\n") << "lower-case hex, as the published Python";
}

TEST(Cosys, DecodingUndoesEncoding) {
  Random random(11);
  CosysDecoder decoder;
  for (int i = 0; i < 3000; ++i) {
    const std::string message = random_text(random, longest_message);
    const auto frames = decode(decoder, text(cosys_encode(message)));
    ASSERT_EQ(frames.size(), 1U);
    EXPECT_EQ(frames[0].outcome, CosysOutcome::ok);
    EXPECT_EQ(frames[0].message, message);
  }
}

TEST(Cosys, RoundTripOverTheLineThroughEveryReceiver) {
  Random random(12);
  for (const auto& row : uart_receivers()) {
    std::vector<std::string> sent;
    Bytes bytes;
    for (int i = 0; i < 30; ++i) {
      sent.push_back(random_text(random, 40));
      const Bytes line = cosys_encode(sent.back());
      bytes.insert(bytes.end(), line.begin(), line.end());
    }
    CosysDecoder decoder;
    std::vector<std::string> heard;
    for (const auto& byte : row.receive(test::send(bytes, baud * 1.02), baud, 0.4)) {
      if (auto frame = decoder.push(byte)) heard.push_back(frame->message);
    }
    EXPECT_EQ(heard, sent) << row.name;
  }
}

// Acceptance test U3: the numbers of the example message on the line.
TEST(Cosys, U3TheExampleMessageOnTheLine) {
  std::vector<bool> bits;
  for (const auto byte : cosys_encode("IND 011111 OK")) {
    for (int slot = 0; slot < bits_per_byte; ++slot) bits.push_back(line_bit(byte, slot));
  }
  ASSERT_EQ(bits.size(), 170U);
  const auto light = std::ranges::count(bits, false);
  EXPECT_NEAR(static_cast<double>(light) / 170, 0.6235, 0.00005);
  std::vector<int> runs_of_length(10, 0);
  int run = 0;
  for (const bool dark : bits) {
    if (dark) ++runs_of_length[static_cast<std::size_t>(run)];
    run = dark ? 0 : run + 1;
  }
  runs_of_length[0] = 0;
  EXPECT_EQ(runs_of_length, (std::vector{0, 17, 19, 8, 1, 1, 3, 0, 0, 0}));  // longest 6 bits
}

TEST(Cosys, MessagesThatCannotBeSentSayWhy) {
  EXPECT_FALSE(problem_in_message("IND 011111 OK"));
  EXPECT_FALSE(problem_in_message(""));
  EXPECT_FALSE(problem_in_message(" ~"));
  EXPECT_EQ(problem_in_message("ab\ncd").value(),
            "byte 0x0a at position 2 is not printable ASCII, 0x20 to 0x7e");
  EXPECT_NE(problem_in_message("\x7f"), std::nullopt);
  EXPECT_NE(problem_in_message("\x1f"), std::nullopt);
  EXPECT_NE(problem_in_message("grad \xc2\xb0").value().find("0xc2 at position 5"),
            std::string::npos);
  EXPECT_FALSE(problem_in_message(std::string(longest_message, 'a')));
  EXPECT_TRUE(problem_in_message(std::string(longest_message + 1, 'a')));
  EXPECT_EQ(problem_in_message(std::string(255, 'a')).value(),
            "its line would be 259 bytes long, 3 over the limit of 256");
  EXPECT_FALSE(problem_in_message("abc", 7));
  EXPECT_TRUE(problem_in_message("abcd", 7));
}

TEST(Cosys, EveryReasonIsReached) {
  EXPECT_EQ(outcome_of("IND 011111 OK 46\n"), CosysOutcome::ok);
  EXPECT_EQ(outcome_of("j 6A\n"), CosysOutcome::ok) << "either case is accepted";
  EXPECT_EQ(outcome_of(" 00\n"), CosysOutcome::ok) << "the empty message";
  EXPECT_EQ(outcome_of("IND\t011111 OK 46\n"), CosysOutcome::unprintable);
  EXPECT_EQ(outcome_of("IND 011111 OK 46\r\n"), CosysOutcome::unprintable);
  EXPECT_EQ(outcome_of("IND 011111 OK \xb4"
                       "6\n"),
            CosysOutcome::unprintable);
  EXPECT_EQ(outcome_of("\n"), CosysOutcome::too_short);
  EXPECT_EQ(outcome_of("46\n"), CosysOutcome::too_short);
  EXPECT_EQ(outcome_of("IND011111OK46\n"), CosysOutcome::too_short) << "no space";
  EXPECT_EQ(outcome_of("IND \n"), CosysOutcome::too_short);
  EXPECT_EQ(outcome_of("IND 4\n"), CosysOutcome::too_short);
  EXPECT_EQ(outcome_of("IND 011111 OK\n"), CosysOutcome::not_hex);
  EXPECT_EQ(outcome_of("IND 011111 OK 046\n"), CosysOutcome::not_hex) << "three digits";
  for (const auto* line : {"j g0\n", "j 0g\n", "j -1\n", "j +1\n", "j 0x\n", "j 6.\n"}) {
    EXPECT_EQ(outcome_of(line), CosysOutcome::not_hex) << line;
  }
  EXPECT_EQ(outcome_of("IND 011111 OK 66\n"), CosysOutcome::wrong_checksum) << "space summed too";
  EXPECT_EQ(outcome_of("IND 011110 OK 46\n"), CosysOutcome::wrong_checksum);
  EXPECT_EQ(outcome_of(std::string(300, 'x') + '\n'), CosysOutcome::overlong);
}

TEST(Cosys, EveryOutcomeHasANameOfItsOwn) {
  EXPECT_EQ(name(CosysOutcome::ok), "ok");
  EXPECT_EQ(name(CosysOutcome::unprintable), "unprintable");
  EXPECT_EQ(name(CosysOutcome::too_short), "too_short");
  EXPECT_EQ(name(CosysOutcome::not_hex), "not_hex");
  EXPECT_EQ(name(CosysOutcome::wrong_checksum), "wrong_checksum");
  EXPECT_EQ(name(CosysOutcome::overlong), "overlong");
}

TEST(Cosys, ARejectedFrameShowsItsLine) {
  const auto frames = decode("IND 1 OK 99\n");
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].message, "IND 1 OK 99");
}

TEST(Cosys, AFrameStartsAtItsFirstByte) {
  const auto frames = decode("a 61\n\nb 62\n" + std::string(300, 'x') + "\nc 63\n");
  ASSERT_EQ(frames.size(), 5U);
  EXPECT_EQ(frames[0].start, Seconds(0));
  EXPECT_EQ(frames[1].start, Seconds(5));
  EXPECT_EQ(frames[2].start, Seconds(6));
  EXPECT_EQ(frames[3].start, Seconds(11));
  EXPECT_EQ(frames[4].start, Seconds(312));
}

TEST(Cosys, TheLimitCountsTheNewlineAndIsReportedOnce) {
  const std::string longest = text(cosys_encode(std::string(252, 'a')));
  ASSERT_EQ(longest.size(), default_max_line);
  EXPECT_EQ(outcome_of(longest), CosysOutcome::ok);
  EXPECT_EQ(outcome_of("a" + longest), CosysOutcome::overlong);

  CosysDecoder decoder(5);
  EXPECT_TRUE(decode(decoder, "abcd").empty());
  const auto overlong = decode(decoder, "e");  // the newline would be the sixth byte
  ASSERT_EQ(overlong.size(), 1U);
  EXPECT_EQ(overlong[0].outcome, CosysOutcome::overlong);
  EXPECT_EQ(overlong[0].message, "abcde");
  EXPECT_TRUE(decode(decoder, std::string(1000, 'f') + '\n').empty()) << "once per line";
  EXPECT_EQ(decode(decoder, "a 61\n").at(0).outcome, CosysOutcome::ok);
  EXPECT_EQ(decode(decoder, "abcde\n").size(), 1U) << "its newline ends it and is no line itself";
}

TEST(Cosys, AFramingErrorAloneIsLeftToTheChecksum) {
  CosysDecoder decoder;
  std::optional<CosysFrame> frame;
  for (const auto byte : cosys_encode("RFID S:U")) frame = decoder.push({Seconds(0), byte, true});
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->outcome, CosysOutcome::ok);
}

TEST(Cosys, OneWrongBitIsNeverAccepted) {
  const std::string good = text(cosys_encode("IND 011111 OK"));
  for (std::size_t i = 0; i + 1 < good.size(); ++i) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      std::string line = good;
      line[i] = static_cast<char>(static_cast<unsigned char>(line[i]) ^ (1U << bit));
      for (const auto& frame : decode(line)) {
        EXPECT_NE(frame.outcome, CosysOutcome::ok) << i << ' ' << bit;
      }
    }
  }
}

TEST(Cosys, TwoWrongBitsOfOneColumnPassUndetected) {
  const auto frames = decode("IND 101111 OK 46\n");  // sent: IND 011111 OK
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].outcome, CosysOutcome::ok);
  EXPECT_NE(frames[0].message, "IND 011111 OK");
}

TEST(Cosys, GarbageIsOneFrameALineAndTheNextMessageIsHeard) {
  Random random(13);
  CosysDecoder decoder(64);
  for (int round = 0; round < 2000; ++round) {
    const std::string garbage = text(test::random_bytes(random, random() % 400));
    std::size_t lines = 0;  // ended by a newline, or grown to the limit
    std::size_t length = 0;
    for (const char c : garbage) {
      const bool ended = c == '\n' && length < 64;
      length = c == '\n' ? 0 : length + 1;
      if (ended || length == 64) ++lines;
    }
    const auto frames = decode(decoder, garbage);
    EXPECT_EQ(frames.size(), lines);
    for (const auto& frame : frames) EXPECT_LE(frame.message.size(), 64U);
    const auto after = decode(decoder, "\nIND 011111 OK 46\n");
    ASSERT_FALSE(after.empty());
    EXPECT_EQ(after.back().outcome, CosysOutcome::ok);
    EXPECT_EQ(after.back().message, "IND 011111 OK");
  }
}

}  // namespace
}  // namespace protocol
