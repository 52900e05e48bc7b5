// What all answers of --json have.
#include <nlohmann/json.hpp>

#include <sstream>

#include "program.hpp"

namespace {

class CommandLineJson : public CommandLine {
 protected:
  /// Of one answer, or of each of lines.
  static std::vector<nlohmann::json> answers_of(const std::string& out) {
    if (nlohmann::json::accept(out)) return {nlohmann::json::parse(out)};
    std::vector<nlohmann::json> all;
    std::istringstream lines(out);
    for (std::string line; std::getline(lines, line);) all.push_back(nlohmann::json::parse(line));
    return all;
  }

  void expect_version(const Words& arguments) const {
    const std::vector<nlohmann::json> answers = answers_of(program(arguments).out);
    EXPECT_FALSE(answers.empty()) << arguments.front();
    for (const nlohmann::json& answer : answers)
      EXPECT_EQ(answer.value("format_version", ""), "1") << arguments.front() << ": " << answer;
  }
};

TEST_F(CommandLineJson, SaysTheVersionOfItsFormat) {
  write_scenario("s.toml", "receiver.range_m = [1, 2]");
  ASSERT_EQ(program({"baseline", "s.toml", "-n", "16", "-q", "-o", "b.h5"}).code, 0);
  ASSERT_EQ(program({"trace", "s.toml", "-o", "t.vcd"}).code, 0);
  write("p.toml", "experiment = \"presence\"");
  write("l.toml", "experiment = \"location\"");
  expect_version({"run", "s.toml", "-q", "-n", "8", "--json"});
  expect_version({"run", "p.toml", "-q", "-n", "8", "--json"});
  expect_version({"find", "s.toml", "--over", "receiver.range_m", "-n", "16", "--json"});
  expect_version({"check", "s.toml", "--baseline", "b.h5", "-q", "--json"});
  expect_version({"compare", "s.toml", "--decoder", "mid-bit", "--decoder", "soft", "-n", "16",
                  "-q", "--json"});
  expect_version({"decode", "t.vcd", "--json"});
  expect_version({"decode", "t.vcd", "t.vcd", "--json"});
  expect_version({"locate", "l.toml", "--json"});
  expect_version({"parts", "--json"});
  expect_version({"parts", "TSOP4856", "--json"});
}

}  // namespace
