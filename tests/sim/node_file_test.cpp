// Files of nodes: what they say, and one line for each thing that cannot be.
#include "sim/node/node_file.hpp"

#include <gtest/gtest.h>

#include "sim/failure.hpp"

namespace sim {
namespace {

const std::string ends = "address = \"A\"\npeer = \"B\"\n";

std::string file_refusal(const std::string& text) {
  try {
    parse_node_file(text, "x.toml");
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::bad_input);
    return failure.what();
  }
  return "accepted";
}

TEST(NodeFile, SaysAllThatANodeNeeds) {
  const NodeFile file = parse_node_file(
      "address = \"C\"\npeer = \"P\"\noutbound = [\"b\", \"a.x y\"]\ninbound = []\n"
      "compressed = false\nbaud = 9600\nfull_set_period_s = 2\nquery_timeout_s = 3\n"
      "send_period_s = 0.5\nmax_size_bytes = 64\n[values]\n\"a.x y\" = \"1\"\n",
      "x.toml");
  EXPECT_EQ(file.settings.address, 'C');
  EXPECT_EQ(file.settings.peer, 'P');
  EXPECT_EQ(file.settings.outbound, (std::vector<std::string>{"b", "a.x y"}));
  EXPECT_TRUE(file.settings.inbound.empty());
  EXPECT_FALSE(file.settings.compressed);
  EXPECT_EQ(file.settings.full_set_every.value, 2);
  EXPECT_EQ(file.settings.query_timeout.value, 3);
  EXPECT_EQ(file.settings.max_size, 64U);
  EXPECT_EQ(file.baud.value, 9600);
  EXPECT_EQ(file.send_period.value, 0.5);
  const protocol::SharedNode node = make_node(file);
  EXPECT_EQ(node.outbound()[0].value, "");
  EXPECT_EQ(node.outbound()[1].value, "1");
}

TEST(NodeFile, ItsBaudSaysHowManyQueriesATransmissionHas) {
  // At 600 baud a query of 14 bytes takes 0.23 s, so a fifth one begins within a second.
  for (const auto& [baud, asked] : {std::pair{"600", 5U}, std::pair{"9600", 8U}}) {
    const std::string names = R"(["a", "b", "c", "d", "e", "f", "g", "h"])";
    protocol::SharedNode node = make_node(
        parse_node_file(ends + "inbound = " + names + "\nbaud = " + baud + "\n", "x.toml"));
    for (std::size_t i = 0; i < node.inbound().size(); ++i) node.ask(i);
    node.transmit(dsp::Seconds(0));
    EXPECT_EQ(node.counts().asked, asked) << baud;
  }
}

TEST(NodeFile, RefusesAddresses) {
  EXPECT_EQ(file_refusal("address = \"Q\"\n"),
            "address = \"Q\" in x.toml:1 (no address) use one capital letter, \"A\" to \"P\"");
  EXPECT_EQ(file_refusal("peer = 2\n"),
            "peer in x.toml:1 (a number where a letter is expected) write it as \"A\"");
  EXPECT_EQ(file_refusal("peer = \"B\"\n"),
            "x.toml (it does not say its address) add a line such as address = \"A\"");
  EXPECT_EQ(file_refusal("address = \"B\"\npeer = \"B\"\n"),
            "peer = \"B\" in x.toml:2 (the node's own address) give the other end's");
}

TEST(NodeFile, RefusesLists) {
  EXPECT_EQ(file_refusal(ends + "outbound = [\"a|b\"]\n"),
            "outbound in x.toml:3 (variable \"a|b\": '|' at position 1 belongs to the format) give "
            "each name once, and use printable ASCII without [, ] and |");
  EXPECT_EQ(
      file_refusal(ends + "inbound = [\"a\", \"\\u00e9\"]\n").find("inbound in x.toml:3 (variable"),
      0U);
  EXPECT_EQ(file_refusal(ends + "inbound = [\"a\",\n\"b\", \"a\"]\n"),
            "inbound in x.toml:3 (variable \"a\" is in the list twice) give each name once, and "
            "use printable ASCII without [, ] and |");
  EXPECT_EQ(
      file_refusal(ends + "outbound = [\"\"]\n").find("outbound in x.toml:3 (a variable has no"),
      0U);
  EXPECT_EQ(file_refusal(ends + "outbound = [1, 2]\n"),
            "outbound in x.toml:3 (a list where a list of names is expected) write it as "
            "[\"AutoGpsLat\", \"AutoGpsLon\"]");
  EXPECT_EQ(file_refusal(ends),
            "x.toml (both lists are empty) add outbound or inbound = [\"A_NAME\"]");
  std::string many = ends + "inbound = [\"0\"";
  for (int i = 1; i <= 4096; ++i) many += ", \"" + std::to_string(i) + "\"";
  EXPECT_EQ(file_refusal(many + "]\n"),
            "inbound in x.toml:3 (4097 variables, 4096 at most) make the list shorter");
}

TEST(NodeFile, RefusesWhatDoesNotFitIntoAMessage) {
  const std::string list = ends + "max_size_bytes = 40\noutbound = [\"Name\"]\n";
  EXPECT_EQ(file_refusal(list + "values.Name = \"" + std::string(19, 'x') + "\"\n"), "accepted");
  EXPECT_EQ(file_refusal(list + "values.Name = \"" + std::string(30, 'x') + "\"\n"),
            "values.Name in x.toml:5 (it would be 46 bytes long, 6 over the limit of 40) use "
            "printable ASCII without [, ] and |, and not too much of it");
  EXPECT_EQ(file_refusal(ends + "max_size_bytes = 16\ninbound = [\"LongName\"]\n"),
            "x.toml (variable \"LongName\": it would be 21 bytes long, 5 over the limit of 16) "
            "shorten the name or raise max_size_bytes");
}

TEST(NodeFile, RefusesKeysAndValues) {
  const std::string list = ends + "outbound = [\"Name\"]\n";
  EXPECT_EQ(file_refusal(list + "adress = \"A\"\n"),
            "adress in x.toml:4 (no such key) did you mean address?");
  EXPECT_EQ(file_refusal(list + "[node]\nbaud = 1\n"),
            "node.baud in x.toml:5 (no such key) did you mean baud?");
  EXPECT_EQ(file_refusal(list + "baud = 0\n"),
            "baud = 0 in x.toml:4 (speed of the line must be at least 50 1/s) use a whole number "
            "50 to 4000000");
  EXPECT_EQ(file_refusal(list + "query_timeout_s = nan\n"),
            "query_timeout_s = nan in x.toml:4 (not a finite number) use a value 0.01 to 86400");
  EXPECT_EQ(file_refusal(list + "compressed = 1\n"),
            "compressed in x.toml:4 (a number where true or false is expected) write it so");
  EXPECT_EQ(file_refusal(list + "[values]\nNmae = \"1\"\n"),
            "values.Nmae in x.toml:5 (no such outbound variable) did you mean Name?");
  EXPECT_EQ(file_refusal(list + "[values]\nName = 1\n"),
            "values.Name in x.toml:5 (a number where text is expected) write the value in quotes");
  EXPECT_EQ(
      file_refusal(list + "[values]\nName = \"a]\"\n").find("values.Name in x.toml:5 (']' at"), 0U);
  EXPECT_EQ(file_refusal(list + "[values]\n"), "accepted");
  EXPECT_EQ(file_refusal(list + "address = \"A\"\n").find("syntax error in x.toml:4"), 0U);
}

}  // namespace
}  // namespace sim
