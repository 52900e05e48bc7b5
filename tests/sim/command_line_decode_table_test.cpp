// decode of many captures and of folders from outside.
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "protocol/cosys.hpp"
#include "protocol/uart.hpp"

namespace sim {
namespace {

using Json = nlohmann::json;

class DecodeTable : public CommandLine {
 protected:
  DecodeTable() {
    std::filesystem::create_directories(path("all/deeper"));
    const std::filesystem::path corpus = COSYS_SOURCE_DIR "/tests/captures";
    std::filesystem::copy_file(corpus / "icarus.vcd", path("all/a.vcd"));
    std::filesystem::copy_file(corpus / "excel_mark.csv", path("all/c.csv"));
    std::filesystem::copy_file(corpus / "rtl_433.ook", path("all/deeper/b.ook"));
    write("all/notes.txt", "no capture\n");
  }

  std::vector<Json> lines_of(const Words& command) const {
    std::vector<Json> lines;
    std::istringstream out(program(command).out);
    for (std::string line; std::getline(out, line);) lines.push_back(Json::parse(line));
    return lines;
  }
};

TEST_F(DecodeTable, HasARowACapture) {
  const Outcome o = program({"decode", "all"});
  EXPECT_EQ(o.code, 0) << o.err;
  const std::string rest = "idle-high         600          17        0         1        0\n";
  EXPECT_EQ(o.out, std::string(79, ' ') + "framing  messages\n" +
                       "capture           format      channel       polarity           Bd  "
                       "characters   errors  accepted  refused\n"
                       "all/a.vcd         vcd         rx            " +
                       rest + "all/c.csv         csv         rx            " + rest +
                       "all/deeper/b.ook  ook         rx            " + rest);
  EXPECT_EQ(o.err, "");
}

TEST_F(DecodeTable, SaysOfEachWhatOneSaysOfItself) {
  const std::vector<Json> rows = lines_of({"decode", "--json", "all/c.csv", "all/a.vcd"});
  ASSERT_EQ(rows.size(), 2U);
  for (const Json& row : rows) {
    const Json alone = lines_of({"decode", "--json", row["file"]}).back();
    EXPECT_EQ(row["line"], alone["line"]);
    EXPECT_EQ(row["messages"], (Json{{"accepted", 1}, {"refused", 0}}));
    EXPECT_EQ(row["exit_code"], 0);
  }
  EXPECT_EQ(rows[0]["file"], "all/c.csv");
}

TEST_F(DecodeTable, GoesOnBehindAFileThatIsNoCapture) {
  write("all/b.csv", "time,rx\n1,maybe\n");
  const Outcome o = program({"decode", "all", "all/notes.txt"});
  EXPECT_EQ(o.code, 2);
  EXPECT_NE(o.out.find("\nall/b.csv  "), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("\nall/c.csv "), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("\nall/notes.txt  "), std::string::npos) << o.out;
  const std::vector<Json> rows = lines_of({"decode", "--json", "all"});
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[1]["exit_code"], 2);
  EXPECT_FALSE(rows[1].contains("line"));
  EXPECT_EQ(program({"decode", "all/b.csv"}).err,
            "cosys-sim: " + rows[1]["problem"].get<std::string>() + "\n");
}

// Two wires that carry the same at two rates: either may be meant.
TEST_F(DecodeTable, LeavesOpenWhatReadsAsWellInTwoWays) {
  std::string vcd =
      "$timescale 1 us $end $var wire 1 ! a $end $var wire 1 % b $end\n"
      "$enddefinitions $end\n#0\n1!\n1%\n";
  std::map<long, std::string> changes;
  const auto add = [&](const char* code, long bit_us, const std::string& text) {
    long at = 10 * bit_us;
    for (const char c : text)
      for (int slot = 0; slot < 10; ++slot, at += bit_us) {
        const bool level = slot > 0 && (slot == 9 || ((c >> (slot - 1)) & 1) != 0);
        changes[at] += std::string(level ? "1" : "0") + code + "\n";
      }
  };
  add("!", 100, "UART at one rate\n");
  add("%", 200, "UART at two rate\n");
  for (const auto& [at, change] : changes) vcd += "#" + std::to_string(at) + "\n" + change;
  write("two.vcd", vcd + "#100000\n");
  const int alone = program({"decode", "two.vcd"}).code;
  ASSERT_EQ(alone, 4);
  const Outcome o = program({"decode", "two.vcd", "all/a.vcd"});
  EXPECT_EQ(o.code, 4);
  EXPECT_NE(o.out.find("say --channel"), std::string::npos) << o.out;
}

TEST_F(DecodeTable, RefusesAFolderWithoutACapture) {
  std::filesystem::create_directory(path("empty"));
  expect_refused({"decode", "empty"}, 2,
                 "no capture in empty (no file there has the ending of one) name the files");
}

// A link that leads nowhere or to itself, and a name that no file can have.
TEST_F(DecodeTable, HasARowForWhatIsNotThere) {
  std::filesystem::create_symlink("nowhere", path("all/b.vcd"));
  std::filesystem::create_symlink("d.vcd", path("all/d.vcd"));
  std::filesystem::create_symlink("loop", path("all/loop"));
  const Outcome o = program({"decode", "all"});
  EXPECT_EQ(o.code, 2);
  EXPECT_EQ(std::ranges::count(o.out, '\n'), 7) << o.out;
  EXPECT_EQ(o.err, "cosys-sim: 2 of 5 captures could not be read\n");
  for (const std::string& name : {std::string("all/d.vcd"), std::string(300, 'x')}) {
    EXPECT_EQ(program({"decode", name}).code, 2);
    const Outcome many = program({"decode", name, "all/a.vcd"});
    EXPECT_EQ(many.code, 2);
    EXPECT_NE(many.out.find("\nall/a.vcd "), std::string::npos) << many.out;
  }
}

/// Of a message, a row a microsecond beside a column that rises and is no time.
std::string levels_at_1_mhz() {
  dsp::LogicTrace line;
  dsp::Seconds at(1e-3);
  for (const std::uint8_t byte : protocol::cosys_encode("IND 011111 OK"))
    at = protocol::send_byte(line, byte, at, dsp::Hertz(9600));
  line.observe_until(at + dsp::Seconds(1e-3));
  dsp::TraceReader reader(line);
  std::string text = "address,rx\n";
  for (int i = 0; i * 1e-6 < line.end().value; ++i)
    text += std::to_string(7 * i) + (reader.level_at(dsp::Seconds(i * 1e-6)) ? ",1\n" : ",0\n");
  return text;
}

// A .bin among files that say their rates or times: what is told is for it alone.
TEST_F(DecodeTable, AppliesWhatIsToldWhereAFileSaysNothing) {
  write_scenario("s.toml", "receiver.range_m = [0.5]");
  for (const char* file :
       {"all/t.bin", "all/t.sr", "all/t.h5", "all/t.sigmf-meta", "all/t.wav", "all/t.csv"})
    ASSERT_EQ(program({"trace", "s.toml", "-o", file}).code, 0) << file;
  write("all/bare.csv", levels_at_1_mhz());
  const Words told{"--sample-rate", "1MHz", "--time-unit", "ms", "--sample-bytes", "1"};
  Words command{"decode", "--json", "all"};
  command.insert(command.end(), told.begin(), told.end());
  std::map<std::string, std::string> times;
  for (const Json& row : lines_of(command)) {
    ASSERT_TRUE(row.contains("messages")) << row;
    EXPECT_GT(row["messages"]["accepted"], 0) << row;
    times[row["file"]] = row["line"]["capture"].value("time", "");
  }
  EXPECT_EQ(times["all/t.bin"], "1000000 samples a second");
  EXPECT_EQ(times["all/a.vcd"], "time in steps of 1e-06 s");
  EXPECT_EQ(times["all/bare.csv"], "1000000 samples a second");
  for (const char* file : {"all/t.h5", "all/t.wav"})
    EXPECT_NE(times[file], times["all/t.bin"]) << "as the file says: " << file;
}

TEST_F(DecodeTable, TakesNamesInBrackets) {
  std::filesystem::create_directory(path("[2024,a]"));
  std::filesystem::copy_file(path("all/a.vcd"), path("[2024,a]/a.vcd"));
  EXPECT_EQ(program({"decode", "[2024,a]"}).code, 0);
  EXPECT_EQ(program({"decode", "all/a.vcd", "[2024,a]"}).code, 0);
}

}  // namespace
}  // namespace sim
