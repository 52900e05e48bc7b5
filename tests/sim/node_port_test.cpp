// Ports of nodes: raw mode and back, one user, links, speeds, and what is no port.
#include "node_process.hpp"

namespace {

void expect_equal(const termios& one, const termios& other) {
  EXPECT_EQ(one.c_iflag, other.c_iflag);
  EXPECT_EQ(one.c_oflag, other.c_oflag);
  EXPECT_EQ(one.c_cflag, other.c_cflag);
  EXPECT_EQ(one.c_lflag, other.c_lflag);
  EXPECT_EQ(::cfgetospeed(&one), ::cfgetospeed(&other));
}

TEST_F(Nodes, MakeTheirDeviceRawAndRestoreIt) {
  const TestDevice device;
  const termios before = device.settings();
  ASSERT_NE(before.c_lflag & ECHO, 0U) << "a new pseudo-terminal echoes";
  for (const int signal : {SIGINT, SIGTERM}) {
    const auto base = base_at(device);
    const termios raw = device.settings();
    EXPECT_EQ(raw.c_lflag & (ICANON | ECHO | ISIG | IEXTEN), 0U);
    EXPECT_EQ(raw.c_iflag & (ICRNL | INLCR | IGNCR | IXON | IXOFF | ISTRIP | INPCK), 0U);
    EXPECT_EQ(raw.c_oflag & OPOST, 0U);
    EXPECT_EQ(raw.c_cflag & (CSIZE | PARENB | CSTOPB | CREAD | CLOCAL), CS8 | CREAD | CLOCAL);
    EXPECT_EQ(::cfgetospeed(&raw), static_cast<speed_t>(B115200));
    base->finish(signal);
    expect_equal(device.settings(), before);
  }
}

TEST_F(Nodes, RestoreTheirDeviceWhenNobodyReadsTheirEvents) {
  const TestDevice device;
  const termios before = device.settings();
  expect_refused({"node", "base.toml", "--device", device.name()}, 3,
                 "cannot write to standard output (it is closed or full) redirect it elsewhere",
                 "/dev/full");
  expect_equal(device.settings(), before);
}

TEST_F(Nodes, HaveADeviceToThemselves) {
  const TestDevice device;
  const auto base = base_at(device);
  const termios raw = device.settings();
  expect_refused({"node", "guard.toml", "--device", device.name(), "--duration", "1s"}, 3,
                 "cannot use " + device.name() +
                     " (another program has locked it) end that, or give another device");
  expect_equal(device.settings(), raw);
  device.read_until("|Dgate 3|");  // unharmed
}

TEST_F(Nodes, EndWhenTheirTimeIsOver) {
  const TestDevice device;
  const auto base = start_node({"base.toml", "--device", device.name(), "--duration", "0.1s"});
  const Outcome o = base->finish();
  EXPECT_EQ(o.code, 0);
  EXPECT_EQ(o.err, "");
  EXPECT_EQ(end_of(o)["reason"], "duration");
  EXPECT_GE(end_of(o)["time_s"], 0.1);
}

/// A device that is made after this is newer than a link that is there: times of files go in steps
/// of up to 10 ms.
void let_times_move_on() { std::this_thread::sleep_for(std::chrono::milliseconds(30)); }

TEST_F(Nodes, ReplaceOnlyLinksOfTheirOwn) {
  namespace fs = std::filesystem;
  const auto refused = [&](const std::string& name) {
    expect_refused({"node", "base.toml", "--pty", name, "--duration", "1s"}, 2,
                   "cannot make the link " + name +
                       " (something else has this name) choose another name, or remove it");
  };
  write("file", "precious");
  refused("file");
  EXPECT_EQ(content(path("file")), "precious");
  fs::create_symlink("nowhere", path("dangling"));
  refused("dangling");
  refused(".");
  const auto base = ready_node({"base.toml", "--pty", "line"});
  refused("line");  // of a node that runs
  const auto killed = ready_node({"base.toml", "--pty", "left"});
  let_times_move_on();
  killed->finish(SIGKILL);
  EXPECT_TRUE(fs::is_symlink(path("left")));
  const auto next = ready_node({"base.toml", "--pty", "left"});
  EXPECT_EQ(next->finish(SIGTERM).code, 130);
  EXPECT_FALSE(fs::is_symlink(path("left")));
  fs::remove(path("line"));
  write("line", "of another");  // meanwhile
  base->finish(SIGTERM);
  EXPECT_EQ(content(path("line")), "of another");
}

TEST_F(Nodes, ReplaceALinkWhoseNumberAnotherHasNow) {
  namespace fs = std::filesystem;
  const auto killed = ready_node({"base.toml", "--pty", "left"});
  let_times_move_on();
  killed->finish(SIGKILL);
  const fs::path number = fs::read_symlink(path("left"));
  std::vector<std::unique_ptr<TestDevice>> others;
  while (!fs::exists(number)) others.push_back(std::make_unique<TestDevice>());
  const auto next = ready_node({"base.toml", "--pty", "left"});
  EXPECT_EQ(next->finish(SIGTERM).code, 130);
}

TEST_F(Nodes, NameLinksThatAreNoUtf8) {
  const auto base = start_node({"base.toml", "--pty", "li\xffne"});
  EXPECT_EQ(base->wait_for("ready")["device"], "li\xef\xbf\xbdne");
  const auto guard = ready_node({"guard.toml", "--device", "li\xffne"});
  guard->wait_for_value("Speed", "1.5");
  EXPECT_EQ(base->finish(SIGTERM).code, 130);
}

TEST_F(Nodes, RefuseWhatIsNoPort) {
  write("file", "");
  const auto at = [](const std::string& device) {
    return Words{"node", "base.toml", "--device", device};
  };
  expect_refused(at("file"), 2,
                 "cannot use file (it is no serial device) give one such as /dev/ttyUSB0, or the "
                 "end of a pseudo-terminal");
  expect_refused(at("missing"), 3,
                 "cannot open missing (No such file or directory) plug it in, or check its name "
                 "and permissions");
  expect_refused({"node", "base.toml"}, 2,
                 "no port is named (a node talks through one) add --device /dev/ttyUSB0, or --pty "
                 "LINK for one that other programs open");
  expect_refused({"node", "base.toml", "--pty", "x", "--device", "y"}, 2,
                 "--device excludes --pty (wrong usage) see cosys-sim node --help");
  expect_refused({"node", "base.toml", "--pty", "missing/x"}, 3,
                 "cannot make the link missing/x (No such file or directory) choose another name");
}

TEST_F(Nodes, RefuseSpeedsThatSerialPortsDoNotHave) {
  const auto with_baud = [](const std::string& baud) {
    return Words{"node", "base.toml", "--pty", "x", "--baud", baud};
  };
  expect_refused(with_baud("601"), 2,
                 "baud = 601 in --baud (no standard speed of serial ports) the nearest is 600");
  expect_refused(with_baud("1e8"), 2,
                 "baud = 100000000 in --baud (no standard speed of serial ports) the nearest is "
                 "4000000");
  expect_refused(with_baud("0"), 2,
                 "--baud: 0 is no number from 1 to 1000000000 (wrong usage) see cosys-sim node "
                 "--help");
  write("odd.toml", "address = 'A'\npeer = 'B'\noutbound = ['x']\nbaud = 100000\n");
  expect_refused({"node", "odd.toml", "--pty", "x"}, 2,
                 "baud = 100000 in odd.toml (no standard speed of serial ports) the nearest is "
                 "115200");
}

}  // namespace
