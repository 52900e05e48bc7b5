#include "sim/node/node_session.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "sim/node/instruction.hpp"
#include "sim/text/standard_output.hpp"

namespace sim {
namespace {

/// A signal between a look at its flag and a poll is seen so late; so is a new user of a port.
constexpr dsp::Seconds longest_wait(0.05);

}  // namespace

NodeSession::NodeSession(const NodeFile& file, Port& port, LineOutput& events)
    : file_(file),
      port_(port),
      node_(make_node(file)),
      input_(STDIN_FILENO, longest_instruction),
      output_(file.baud),
      events_(events),
      connected_(port.descriptor() >= 0) {}

dsp::Seconds NodeSession::now() const {
  return dsp::Seconds(
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count());
}

ExitCode NodeSession::run(dsp::Seconds duration, const std::atomic<bool>& stopping) {
  events_.ready(now(), port_.name(), file_);
  try {
    while (!stopping && now() < duration) step(duration);
  } catch (const Failure&) {
    events_.end(now(), "failure", node_.counts(), counts_);
    throw;
  }
  events_.end(now(), stopping ? "signal" : "duration", node_.counts(), counts_);
  return stopping ? ExitCode::interrupted : ExitCode::done;
}

void NodeSession::step(dsp::Seconds end) {
  wait(end);
  const dsp::Seconds at = now();
  give_up(at);
  if (can_hear_) hear(at);
  if (can_read_) heed_instructions();
  transmit(at);
  send(at);
  events_.check();
}

int NodeSession::watched_port() {
  const int descriptor = port_.descriptor();
  const bool connected = descriptor >= 0;
  if (std::exchange(connected_, connected) == connected) return descriptor;
  events_.port(now(), connected ? "connected" : "disconnected");
  if (connected) node_.resend();
  return descriptor;
}

void NodeSession::wait(dsp::Seconds until) {
  const dsp::Seconds from = now();
  until = std::min({until, next_transmission_, from + longest_wait});
  if (!output_.is_empty()) until = std::min(until, output_.next());
  const double ms = std::ceil(std::max(0.0, (until - from).value) * 1e3);
  std::array<pollfd, 2> ends{{{watched_port(), POLLIN, 0}, {input_.descriptor(), POLLIN, 0}}};
  const bool polled = ::poll(ends.data(), ends.size(), static_cast<int>(ms)) > 0;
  can_hear_ = polled && ends[0].revents != 0;
  can_read_ = polled && ends[1].revents != 0;
}

void NodeSession::hear(dsp::Seconds at) {
  const protocol::Bytes bytes = port_.read();
  counts_.bytes_received += bytes.size();
  for (const std::uint8_t byte : bytes) take(byte, at);
}

void NodeSession::take(std::uint8_t byte, dsp::Seconds at) {
  const protocol::SharedNodeCounts before = node_.counts();
  const protocol::SharedNodeNews news = node_.receive({at, byte, false});
  for (const std::size_t variable : news.changed)
    events_.value(at, "changed", node_.inbound()[variable]);
  for (const std::size_t variable : news.answered)
    events_.value(at, "answered", node_.inbound()[variable]);
  for (const std::size_t variable : news.late)
    events_.value(at, "answered_late", node_.inbound()[variable]);
  events_.misfits(at, before, node_.counts(), news.text);
  if (node_.counts().from_self != before.from_self) warn_of_own_address(at, news.text);
}

void NodeSession::warn_of_own_address(dsp::Seconds at, const std::string& message) {
  if (warned_) return;
  warned_ = true;
  events_.own_address(at, message);
  say("cosys-sim: a message from this node's own address came in (another node has it too, or the "
      "line echoes) give each end an address of its own\n");
}

void NodeSession::heed_instructions() {
  for (const std::string& line : input_.read()) {
    try {
      obey(node_, line);
    } catch (const Failure& refusal) {
      say(std::string("cosys-sim: ") + refusal.what() + "\n");
    }
  }
}

void NodeSession::give_up(dsp::Seconds at) {
  for (const std::size_t variable : node_.give_up(at))
    events_.timed_out(at, node_.inbound()[variable].name);
}

/// Only what the line has room for is made: while one transmission is on its way, values may change
/// again. A port that takes nothing loses what has not begun.
void NodeSession::transmit(dsp::Seconds at) {
  if (at < next_transmission_) return;
  next_transmission_ = std::max(next_transmission_ + file_.send_period, at);
  if (!output_.is_empty() && !output_.is_stuck()) return;
  if (output_.is_stuck()) drop(at);
  output_.push(node_.transmit(at), at);
}

void NodeSession::drop(dsp::Seconds at) {
  if (!std::exchange(blocked_, true)) events_.port(at, "blocked");
  counts_.dropped += output_.drop_unbegun();
  node_.resend();
}

void NodeSession::send(dsp::Seconds at) {
  const auto bytes = output_.due(at);
  if (bytes.empty()) return;
  const std::size_t taken = port_.write(bytes);
  counts_.bytes_sent += taken;
  output_.take(taken, at);
  if (!output_.is_stuck()) blocked_ = false;
}

}  // namespace sim
