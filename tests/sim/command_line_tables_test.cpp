// Results as tables: run, find, merge, check and locate into .csv and .json.
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace {

class CommandLineTables : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    write_scenario("s.toml", "receiver.range_m = [1, 3]");
  }

  /// Frames, lost frames and digits of the distance, by Python's own readers.
  std::string read_by_python(const std::string& rows, const std::string& file) const {
    return tool("python3", {"-c", "import csv, json\nfor row in " + rows + "(open('" + file +
                                      "')):\n  row = json.loads(row) if type(row) is str else row\n"
                                      "  print(int(row['n_frames']), int(row['n_frames_lost']), "
                                      "float(row['receiver_range_m']), row['stop_reason'])"});
  }
};

TEST_F(CommandLineTables, AreReadByPython) {
  ASSERT_EQ(program({"run", "s.toml", "-q", "-n", "8"}).code, 0);
  for (const std::string file : {"t.csv", "t.json"}) {
    const std::string reader = file.ends_with("csv") ? "csv.DictReader" : "list";
    const std::string rows = "8 0 1.0 max_frames\n8 8 3.0 max_frames\n";
    for (int time = 0; time < 2; ++time)  // the second replaces the first
      EXPECT_EQ(program({"run", "s.toml", "-q", "-n", "8", "-o", file}).code, 0);
    EXPECT_EQ(read_by_python(reader, file), rows);
    EXPECT_EQ(program({"merge", "s.h5", "-o", "merged-" + file}).code, 0);
    EXPECT_EQ(read_by_python(reader, "merged-" + file), rows);
  }
  EXPECT_EQ(
      program({"find", "s.toml", "--over", "receiver.range_m=1:9", "-n", "200", "-o", "f.csv"})
          .code,
      0);
  EXPECT_TRUE(read_by_python("csv.DictReader", "f.csv").starts_with("200 0 1.0 "));
}

TEST_F(CommandLineTables, HaveARowForEachPointOfACheck) {
  ASSERT_EQ(program({"baseline", "s.toml", "-n", "16", "-q", "-o", "b.h5"}).code, 0);
  for (const std::string file : {"c.csv", "c.json"})
    for (int time = 0; time < 2; ++time)  // the second replaces the first
      program({"check", "s.toml", "--baseline", "b.h5", "-q", "-o", file});
  EXPECT_EQ(content(path("c.csv")).substr(0, 29), "name,scenario,point,verdict,p");
  const std::string column = "import csv, json\nfor row in map(json.loads, open('c.json')):\n  ";
  EXPECT_EQ(tool("python3", {"-c", column + "print(row['point'], row['candidate_n_frames_lost'])"}),
            "0 0\n1 16\n");
  EXPECT_EQ(tool("python3", {"-c",
                             "import csv\nfor row in csv.DictReader(open('c.csv')):\n  "
                             "print(row['point'], row['candidate_n_frames_lost'])"}),
            "0 0\n1 16\n");
  write("mine.csv", "x\n");
  for (const auto& [name, why] :
       {std::pair{"mine.csv",
                  "cannot write mine.csv (it exists and is not a table of cosys-sim "
                  "check) choose another name"},
        {"c.txt",
         "cannot write a table into c.txt (its ending names no format) end the name in "
         ".csv or .json (JSON lines)"}})
    expect_refused({"check", "s.toml", "--baseline", "b.h5", "-q", "-o", name}, 2, why);
}

TEST_F(CommandLineTables, HaveARowForEachPlaceOfReadings) {
  write("l.toml", "experiment = \"location\"");
  for (const std::string file : {"l.csv", "l.json"})
    for (int time = 0; time < 2; ++time)
      EXPECT_EQ(program({"locate", "l.toml", "-o", file}).code, 0);
  const auto answer = nlohmann::json::parse(program({"locate", "l.toml", "--json"}).out);
  const auto row = nlohmann::json::parse(content(path("l.json")));
  EXPECT_EQ(row.at("outcome"), "located");
  EXPECT_EQ(row.at("x_m"), answer.at("places")[0].at("x_m"));
  EXPECT_EQ(row.at("ellipse_semi_major_m"),
            answer.at("places")[0].at("ellipse_95").at("semi_major_m"));
  EXPECT_TRUE(content(path("l.csv")).starts_with("outcome,degrees_of_freedom,probability,x_m,"));
}

TEST_F(CommandLineTables, AreNotGoneOnWith) {
  const std::vector<Words> options{{"--resume"}, {"--shard", "1/2"}};
  for (const Words& option : options) {
    Words arguments{"run", "s.toml", "-o", "t.csv"};
    arguments.insert(arguments.end(), option.begin(), option.end());
    const auto refused = program(arguments);
    EXPECT_EQ(refused.code, 2);
    EXPECT_EQ(refused.err,
              "cosys-sim: " + option[0] +
                  " with t.csv (a table keeps no trials to go on with) write to a name that ends "
                  "in .h5; cosys-sim merge FILE.h5 -o t.csv makes a table of it\n");
  }
  EXPECT_FALSE(std::filesystem::exists(path("t.csv")));
}

TEST_F(CommandLineTables, AreOfOneScenario) {
  write_scenario("other.toml", "receiver.range_m = 1");
  for (const std::string file : {"t.csv", "t.h5"})
    expect_refused({"run", "s.toml", "other.toml", "-o", file}, 2,
                   "-o " + file +
                       " with 2 scenarios (a file holds the result of one) name a folder, such as "
                       "-o results/");
}

TEST_F(CommandLineTables, HaveAnEndingOfAFormatAndReplaceNoOtherFile) {
  const auto unknown = program({"run", "s.toml", "-o", "t.foo"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_EQ(unknown.err,
            "cosys-sim: cannot write a result into t.foo (its ending names no format) end the name "
            "in .h5, .csv or .json (JSON lines)\n");
  for (const std::string file : {"own.csv", "own.json"}) {
    write(file, "[1, 2]\n");
    const auto refused = program({"run", "s.toml", "-o", file});
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find("it exists and is not a result of cosys-sim"), std::string::npos);
    EXPECT_EQ(content(path(file)), "[1, 2]\n");
  }
}

}  // namespace
