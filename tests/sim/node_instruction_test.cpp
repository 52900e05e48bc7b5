// Lines that tell a node what to do, and one line of refusal for those that cannot be done.
#include <gtest/gtest.h>

#include "sim/failure.hpp"
#include "sim/node/instruction.hpp"

namespace sim {
namespace {

protocol::SharedNode some_node() {
  return protocol::SharedNode({.outbound = {"Goal", "a", "a=b", "?x"}, .inbound = {"Lat", "Lon"}});
}

std::string line_refusal(const std::string& line) {
  protocol::SharedNode node = some_node();
  try {
    obey(node, line);
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::bad_input);
    return failure.what();
  }
  return "obeyed";
}

std::string value_after(const std::string& line, std::size_t variable) {
  protocol::SharedNode node = some_node();
  obey(node, line);
  return node.outbound()[variable].value;
}

std::string sent_after(const std::string& line) {
  protocol::SharedNode node = some_node();
  obey(node, line);
  const protocol::Bytes bytes = node.transmit(dsp::Seconds(0));
  return {bytes.begin(), bytes.end()};
}

TEST(Instruction, SetsValues) {
  EXPECT_EQ(value_after("Goal=gate 3", 0), "gate 3");
  EXPECT_EQ(value_after("Goal= x=y ", 0), " x=y ");
  EXPECT_EQ(value_after("a=c", 1), "c");
  EXPECT_EQ(value_after("a=b=c", 2), "c") << "the longest name that fits";
  EXPECT_EQ(value_after("{\"set\": {\"Goal\": \"1\", \"?x\": \"2\"}}", 3), "2");
  EXPECT_EQ(line_refusal(""), "obeyed");
}

TEST(Instruction, SetsAllOrNothing) {
  for (const char* wrong : {R"("nope": "1")", R"("a": "x|y")", R"("Lat": "1")"}) {
    protocol::SharedNode node = some_node();
    EXPECT_THROW(obey(node, std::string(R"({"set": {"?x": "7", "Goal": "9", )") + wrong + "}}"),
                 Failure);
    for (const auto& variable : node.outbound()) EXPECT_EQ(variable.value, "") << wrong;
  }
}

TEST(Instruction, AsksForVariables) {
  EXPECT_TRUE(sent_after("?Lon").starts_with("[:BA|QLon|C"));
  EXPECT_TRUE(sent_after("{\"ask\": \"Lat\"}").starts_with("[:BA|QLat|C"));
}

TEST(Instruction, RefusesWhatCannotBeDone) {
  EXPECT_EQ(line_refusal("Gaol=1"),
            "cannot set Gaol (no such outbound variable) did you mean Goal?");
  EXPECT_EQ(line_refusal("Lat=1"),
            "cannot set Lat (it is inbound, the peer's to set) ask for it by ?Lat");
  EXPECT_EQ(line_refusal("Goal="),
            "cannot set Goal (an empty value cannot be sent: it says that nothing "
            "has changed) it stays as it is");
  EXPECT_EQ(line_refusal("Goal=a|b"),
            "cannot set Goal ('|' at position 1 belongs to the format) it stays as it is");
  EXPECT_EQ(line_refusal("?Goal"),
            "cannot ask for Goal (no such inbound variable) did you mean Lat?");
  EXPECT_EQ(line_refusal("hello"),
            "cannot read a line of stdin (neither a value nor a question) write "
            "Name=value or ?Name");
  EXPECT_EQ(line_refusal("{\"set\":"),
            "cannot read a line of stdin (it begins as JSON but is none) "
            "write Name=value or ?Name");
  const std::string meaningless =
      "cannot read a line of stdin (a JSON object that means nothing here) write {\"set\": "
      "{\"Name\": \"value\"}} or {\"ask\": \"Name\"}";
  EXPECT_EQ(line_refusal("{\"set\": {\"Goal\": 1}}"), meaningless);
  EXPECT_EQ(line_refusal("{\"ask\": [\"Lat\"]}"), meaningless);
  EXPECT_EQ(line_refusal("{}"), meaningless);
  EXPECT_EQ(line_refusal("Goal=" + std::string(1 << 16, 'x')),
            "cannot read a line of stdin (longer than 64 KiB) write Name=value or ?Name");
}

TEST(Instruction, RefusesAllOfANodeWithoutVariables) {
  protocol::SharedNode silent({.outbound = {}, .inbound = {"Lat"}});
  EXPECT_THROW(obey(silent, "Goal=1"), Failure);
}

}  // namespace
}  // namespace sim
