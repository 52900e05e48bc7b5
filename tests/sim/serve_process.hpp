#pragma once
// `cosys-sim serve` from outside, with a reader at its port.
#include <termios.h>

#include <memory>

#include "live_process.hpp"

/// A program at the port, which it opens by its link as any serial device.
class PortReader {
 public:
  explicit PortReader(const std::filesystem::path& link)
      : port_(::open(link.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)) {
    if (port_ < 0) throw std::runtime_error("cannot open " + link.string());
  }
  PortReader(const PortReader&) = delete;
  PortReader& operator=(const PortReader&) = delete;
  ~PortReader() { ::close(port_); }

  /// So many bytes, or more that are there already.
  std::string read(std::size_t n) const {
    const Patience patience;
    std::string text;
    while (text.size() < n) {
      patience.await_input(port_, "bytes behind " + text);
      char buffer[4096];
      const ssize_t some = ::read(port_, buffer, sizeof buffer);
      if (some <= 0) throw std::runtime_error("the end, behind " + text);
      text.append(buffer, static_cast<std::size_t>(some));
    }
    return text;
  }
  std::string read_until(const std::string& end) const { return ::read_until(port_, end); }
  /// Whether there is something to read.
  bool has_more() const {
    pollfd one{.fd = port_, .events = POLLIN, .revents = 0};
    return ::poll(&one, 1, 0) == 1;
  }
  void write(const std::string& text) const { write_all(port_, text); }
  termios settings() const {
    termios now{};
    ::tcgetattr(port_, &now);
    return now;
  }

 private:
  int port_;
};

/// Scenarios in the folder: of bits that are decided without a waveform, which takes no time, and
/// of a module without noise, which hears all or nothing.
class Serve : public CommandLine {
 protected:
  Serve() {
    std::signal(SIGPIPE, SIG_IGN);  // one that has died fails its test alone
    write("bits.toml",
          "[receiver]\nmodule = 'ideal-coherent'\nebn0_db = 20\n"
          "[simulation]\nfidelity = 'decision'\nsample_rate_hz = 300000\nwarmup_messages = 1\n");
    write("module.toml",
          "[receiver]\nrange_m = 0.5\n[noise]\nscale = 0\n[module]\nagc_attack_db_per_ms = 0\n"
          "[simulation]\nsample_rate_hz = 250000\nwarmup_messages = 1\n");
  }

  std::unique_ptr<LiveProcess> start(Words arguments) const {
    arguments.insert(arguments.begin(), {"serve", "--json"});
    return std::make_unique<LiveProcess>(folder(), arguments);
  }
  /// Its port is there when this returns.
  std::unique_ptr<LiveProcess> ready(const Words& arguments) const {
    auto line = start(arguments);
    line->await_words(is_at + path("ttyCOSYS").string());
    return line;
  }
  /// All that one says of a while of its line, with nobody at the port.
  std::string messages(Words arguments) const {
    arguments.insert(arguments.begin(), {"serve", "--json", "--start-at-once"});
    const Outcome o = program(arguments);
    EXPECT_EQ(o.code, 0) << o.err;
    return o.out;
  }

  static nlohmann::json wait_for_outcome(LiveProcess& line, const std::string& outcome) {
    return line.wait_until(outcome, [&](const nlohmann::json& json) {
      return json.contains("outcome") && json["outcome"] == outcome;
    });
  }

  const std::string is_at = "cosys-sim: the line is at ";
  const std::string message = "IND 011111 OK 46\n";
};

/// A number of each line of messages.
inline std::uint64_t sum_of(const std::string& messages, const std::string& what) {
  std::istringstream lines(messages);
  std::uint64_t sum = 0;
  for (std::string line; std::getline(lines, line);)
    sum += nlohmann::json::parse(line).at(what).get<std::uint64_t>();
  return sum;
}

/// All bytes that messages say were heard, as they show them.
inline std::string heard_in(const std::string& messages) {
  std::istringstream lines(messages);
  std::string all;
  for (std::string line; std::getline(lines, line);)
    all += nlohmann::json::parse(line).at("heard").get<std::string>();
  return all;
}
