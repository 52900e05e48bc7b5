// Two nodes at the ends of one line, each a process of its own: their lists, queries and signals.
#include "node_process.hpp"

namespace {

class NodePair : public Nodes {
 protected:
  NodePair() {
    write_like("base.toml", patient, "base.toml");
    write_like("guard.toml", patient, "guard.toml");
    base = ready_node({"base.toml", "--pty", "line"});
    guard = ready_node({"guard.toml", "--device", "line"});
  }

  const char* patient = "query_timeout_s = 100";
  std::unique_ptr<NodeProcess> base, guard;
};

TEST_F(NodePair, MirrorTheirLists) {
  base->wait_for("connected");
  base->wait_for_value("Lon", "-113.1");
  guard->wait_for_value("Speed", "1.5");
  base->write("Goal=gate 4\r\nSpeed=0\n");
  guard->wait_for_value("Goal", "gate 4");
  guard->wait_for_value("Speed", "0");
  guard->write("Lat=40.2\n");
  base->wait_for_value("Lat", "40.2");
  for (const auto* node : {&guard, &base}) {
    const Outcome o = (*node)->finish(SIGTERM);
    EXPECT_EQ(o.code, 130);
    EXPECT_EQ(o.err, stopping);
    EXPECT_EQ(end_of(o)["reason"], "signal");
    EXPECT_EQ(end_of(o)["event"], "end");
    EXPECT_GT(end_of(o)["accepted"], 0);
  }
  EXPECT_EQ(files(), (std::set<std::string>{"base.toml", "guard.toml"}));
}

TEST_F(NodePair, AnswerQueries) {
  base->wait_for_value("Lat", "40.1");
  base->write("?Lat\n");
  EXPECT_EQ(base->wait_for("answered")["value"], "40.1");  // which it knew, so it has not changed
  guard->wait_for_value("Goal", "gate 3");
  guard->write("{\"ask\": \"Goal\"}\n");
  EXPECT_EQ(guard->wait_for("answered")["value"], "gate 3");
  const auto end = end_of(guard->finish(SIGINT));
  EXPECT_EQ(end["asked"], 1);
  EXPECT_EQ(end["answered"], 1);
}

// While nobody is at the other end the node sends on, as into an open line.
// A newcomer does not wait for the next full set.
TEST_F(Nodes, OneThatComesGetsAllAtOnce) {
  write_like("base.toml", "full_set_period_s = 3600", "base.toml");
  const auto base = ready_node({"base.toml", "--pty", "line"});
  for (int i = 0; i < 2; ++i) {
    const auto guard = ready_node({"guard.toml", "--device", "line"});
    guard->wait_for_value("Speed", "1.5");
    guard->finish(SIGINT);
    base->wait_for("disconnected");
  }
}

TEST_F(Nodes, OneMayLeaveAndAnotherCome) {
  write_like("base.toml", "query_timeout_s = 0.1", "base.toml");
  const auto base = ready_node({"base.toml", "--pty", "line"});
  {
    const auto guard = ready_node({"guard.toml", "--device", "line"});
    base->wait_for_value("Lat", "40.1");
  }
  base->wait_for("disconnected");
  base->write("Goal=gate 5\n?Lat\n");
  base->wait_for("timed_out", {{"name", "Lat"}});
  const auto guard = ready_node({"guard.toml", "--device", "line"});
  base->wait_for("connected");
  EXPECT_EQ(guard->wait_for("changed")["value"], "gate 5");
  EXPECT_EQ(end_of(base->finish(SIGINT))["dropped"], 0);  // an open line takes all
}

TEST_F(Nodes, TwoOfOneAddressSaySoAndTakeNothing) {
  write_like("base.toml", "query_timeout_s = 0.1\ncompressed = false", "base.toml");
  const auto one = ready_node({"base.toml", "--pty", "line"});
  const auto other = ready_node({"base.toml", "--device", "line"});
  for (const auto* node : {&one, &other}) {
    EXPECT_TRUE((*node)->wait_for("own_address")["message"].get<std::string>().starts_with(":BA|"));
    (*node)->write("?Lat\n");
    (*node)->wait_for("timed_out");  // several messages later
  }
  for (const auto* node : {&other, &one}) {
    const Outcome o = (*node)->finish(SIGINT);
    EXPECT_EQ(o.code, 130);
    EXPECT_EQ(o.err,
              "cosys-sim: a message from this node's own address came in (another node has it too, "
              "or the line echoes) give each end an address of its own\n" +
                  stopping);
    EXPECT_EQ(o.out.find("changed"), std::string::npos);
    EXPECT_GT(end_of(o)["from_self"], 1);
    EXPECT_EQ(end_of(o)["accepted"], 0);
  }
}

TEST_F(Nodes, TheShippedPairMirrorsItsLists) {
  const std::string nodes = COSYS_SOURCE_DIR "/scenarios/nodes/";
  const auto base = ready_node({nodes + "base.toml", "--pty", "line", "--baud", "115200"});
  const auto guard = ready_node({nodes + "guard.toml", "--device", "line", "--baud", "115200"});
  base->wait_for_value("AutoGpsVel", "22.1");
  guard->wait_for_value("Goal", "gate 3");
}

}  // namespace
