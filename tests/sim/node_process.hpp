#pragma once
// `cosys-sim node` from outside: processes with a stdin to write to and events to wait for, and a
// pseudo-terminal whose other end is the test's own.
#include <termios.h>

#include <memory>

#include "live_process.hpp"
#include "protocol/shared_link.hpp"

class NodeProcess : public LiveProcess {
 public:
  NodeProcess(const std::filesystem::path& folder, Words arguments)
      : LiveProcess(folder, command(std::move(arguments))) {}

  /// The next event that is so; those before it are passed over.
  nlohmann::json wait_for(const std::string& event, const nlohmann::json& with = {}) {
    return wait_until(event + " " + with.dump(), [&](const nlohmann::json& json) {
      auto wanted = json;
      wanted.update(with.is_null() ? nlohmann::json::object() : with);
      return json.at("event") == event && wanted == json;
    });
  }
  nlohmann::json wait_for_value(const std::string& name, const std::string& value) {
    return wait_for("changed", {{"name", name}, {"value", value}});
  }

 private:
  static Words command(Words arguments) {
    arguments.insert(arguments.begin(), "node");
    return arguments;
  }
};

/// The last event of a node.
inline nlohmann::json end_of(const Outcome& o) {
  const std::size_t last = o.out.rfind('\n', o.out.size() - 2);
  return nlohmann::json::parse(o.out.substr(last == std::string::npos ? 0 : last + 1));
}

/// A pseudo-terminal that stands for a device: the node has its end, the test the other.
class TestDevice {
 public:
  TestDevice() : ours_(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)) {
    if (::grantpt(ours_) != 0 || ::unlockpt(ours_) != 0) throw std::runtime_error("no pty");
    name_ = ::ptsname(ours_);
    kept_ = ::open(name_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  }
  TestDevice(const TestDevice&) = delete;
  TestDevice& operator=(const TestDevice&) = delete;
  ~TestDevice() {
    vanish();
    ::close(kept_);
  }

  const std::string& name() const { return name_; }
  /// Is pulled out.
  void vanish() {
    if (ours_ >= 0) ::close(std::exchange(ours_, -1));
  }
  /// Takes no bytes from the node, until it does again.
  void stop() const { ::tcflow(kept_, TCOOFF); }
  void resume() const { ::tcflow(kept_, TCOON); }
  termios settings() const {
    termios now{};
    ::tcgetattr(kept_, &now);
    return now;
  }
  void write(const std::string& text) const { write_all(ours_, text); }
  /// What the node sends, up to and with this.
  std::string read_until(const std::string& end) const { return ::read_until(ours_, end); }

 private:
  int ours_, kept_ = -1;  // kept, so that its settings outlive the node
  std::string name_;
};

/// A message from the guard, node B, to the base, node A.
inline std::string from_guard(const std::vector<protocol::SharedLinkField>& fields) {
  const auto bytes = protocol::shared_link_encode({'A', 'B', fields});
  return {bytes.begin(), bytes.end()};
}

/// Two ends of one link, as files in the folder: base.toml has A, guard.toml has B.
class Nodes : public CommandLine {
 protected:
  Nodes() {
    std::signal(SIGPIPE, SIG_IGN);  // a node that has died fails its test alone
    write("base.toml", "address = \"A\"\npeer = \"B\"\n" + common +
                           "outbound = [\"Goal\", \"Speed\"]\ninbound = [\"Lat\", \"Lon\"]\n"
                           "[values]\nGoal = \"gate 3\"\nSpeed = \"1.5\"\n");
    write("guard.toml", "address = \"B\"\npeer = \"A\"\n" + common +
                            "outbound = [\"Lat\", \"Lon\"]\ninbound = [\"Goal\", \"Speed\"]\n"
                            "[values]\nLat = \"40.1\"\nLon = \"-113.1\"\n");
  }

  std::unique_ptr<NodeProcess> start_node(const Words& arguments) const {
    return std::make_unique<NodeProcess>(folder(), arguments);
  }
  /// Has opened its port when this returns.
  std::unique_ptr<NodeProcess> ready_node(const Words& arguments) const {
    auto node = start_node(arguments);
    node->wait_for("ready");
    return node;
  }
  std::unique_ptr<NodeProcess> base_at(const TestDevice& device) const {
    return ready_node({"base.toml", "--device", device.name()});
  }

  /// A file like another, with a line more.
  void write_like(const std::string& old, const std::string& line, const std::string& name) const {
    write(name, line + "\n" + content(path(old)));
  }

  const std::string common = "baud = 115200\nsend_period_s = 0.01\n";
};
