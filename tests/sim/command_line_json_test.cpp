// What all answers of --json have: the fields of the schema that is shipped, and its page.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "program.hpp"

namespace {

class CommandLineJson : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    if (start_tool("python3", {"-c", "import jsonschema"}).finish().code != 0)
      GTEST_SKIP() << "needs Python's jsonschema";
    write_scenario("s.toml", "receiver.range_m = [1, 2]");
  }

  /// An answer that is validated by a definition of the schema.
  void keep(const std::string& definition, const std::string& answer) {
    EXPECT_NE(answer, "") << definition;
    const std::string file = fmt::format("answer-{}", answers_.size() / 2);
    write(file, answer);
    answers_.insert(answers_.end(), {definition, file});
  }
  void ask(const std::string& definition, const Words& arguments) {
    keep(definition, program(arguments).out);
  }

  /// What is wrong with all that was kept; empty where nothing is.
  std::string problems() const {
    Words words{COSYS_SOURCE_DIR "/tests/sim/validate_answers.py", schema};
    words.insert(words.end(), answers_.begin(), answers_.end());
    return tool("python3", words);
  }

  const std::string schema = COSYS_SOURCE_DIR "/sim/answers.schema.json";

 private:
  Words answers_;
};

TEST_F(CommandLineJson, IsValidByItsSchema) {
  ASSERT_EQ(program({"baseline", "s.toml", "-n", "16", "-q", "-o", "b.h5"}).code, 0);
  ASSERT_EQ(program({"trace", "s.toml", "-o", "t.vcd"}).code, 0);
  write("p.toml", "experiment = \"presence\"");
  write("l.toml", "experiment = \"location\"");
  ask("run_link", {"run", "s.toml", "-q", "-n", "8", "--json"});
  ask("run_experiment", {"run", "p.toml", "-q", "-n", "8", "--json"});
  ask("run_link", {"find", "s.toml", "--over", "receiver.range_m", "-n", "16", "--json"});
  ask("check", {"check", "s.toml", "--baseline", "b.h5", "-q", "--json"});
  ask("compare", {"compare", "s.toml", "--decoder", "mid-bit", "--decoder", "soft", "-n", "16",
                  "-q", "--json"});
  ask("decode", {"decode", "t.vcd", "--json"});
  ask("decode_file", {"decode", "t.vcd", "t.vcd", "--json"});
  ask("locate", {"locate", "l.toml", "--json"});
  ask("parts", {"parts", "--json"});
  for (const char* part : {"TSOP4856", "TSAL6200", "indoor", "BPW34"})
    ask("part", {"parts", part, "--json"});
  EXPECT_EQ(problems(), "");
}

TEST_F(CommandLineJson, SchemaSeesWhatIsNoAnswer) {
  const auto right = nlohmann::json::parse(program({"parts", "--json"}).out);
  auto nameless = right, other = right;
  nameless["parts"][0].erase("name");
  other["format_version"] = "2";
  keep("parts", nameless.dump());
  keep("parts", other.dump());
  const std::string wrong = problems();
  EXPECT_NE(wrong.find("in answer-0: parts/0: 'name' is a required"), std::string::npos) << wrong;
  EXPECT_NE(wrong.find("in answer-1: format_version: "), std::string::npos) << wrong;
}

TEST_F(CommandLineJson, PageIsThatOfTheSchema) {
  EXPECT_EQ(tool("python3", {COSYS_SOURCE_DIR "/tests/sim/answers_page.py", schema}),
            content(COSYS_SOURCE_DIR "/sim/ANSWERS.md"))
      << "sim/ANSWERS.md: python3 tests/sim/answers_page.py sim/answers.schema.json > "
         "sim/ANSWERS.md";
}

}  // namespace
