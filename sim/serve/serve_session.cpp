#include "sim/serve/serve_session.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <utility>

#include "sim/serve/serve_report.hpp"
#include "sim/text/escaped_text.hpp"
#include "sim/text/standard_output.hpp"

namespace sim {
namespace {

constexpr std::size_t longest_line = std::size_t{1} << 16U;

/// A signal between a look at its flag and a poll is seen so late; so is a new reader.
constexpr dsp::Seconds longest_wait(0.05);
constexpr std::chrono::milliseconds patience(50);  // the same while a message is being made

/// Later than this on the wall is worth a word.
constexpr dsp::Seconds noticeable(0.1);

bool has_no_stop_bit(const LineByte& byte) { return byte.framing_error; }

timespec span_of(dsp::Seconds wait) {
  const double s = std::max(0.0, wait.value);
  const double whole = std::floor(s);
  return {static_cast<std::time_t>(whole), static_cast<long>((s - whole) * 1e9)};
}

}  // namespace

ServeSession::ServeSession(LiveScenario scenario, Port& port, LineOutput* messages,
                           const ServeSettings& settings)
    : scenario_(std::move(scenario)),
      port_(port),
      messages_(messages),
      settings_(settings),
      input_(STDIN_FILENO, longest_line) {}

ExitCode ServeSession::run(const std::atomic<bool>& stopping) {
  stopping_ = &stopping;
  ahead_.begin(scenario_.link(), next_);
  say(fmt::format("cosys-sim: the line is at {}{}\n",
                  std::filesystem::absolute(port_.name()).string(),
                  settings_.start_at_once ? "" : "; it starts when somebody opens it"));
  if (!settings_.start_at_once) await_reader();
  begin_message();
  start_ = Clock::now();
  while (goes_on()) play();
  report_end();
  return stopping ? ExitCode::interrupted : ExitCode::done;
}

dsp::Seconds ServeSession::since_start() const {
  return dsp::Seconds(std::chrono::duration<double>(Clock::now() - start_).count());
}

dsp::Seconds ServeSession::now() const {
  return std::min(since_start() * settings_.speed, settings_.duration);
}

/// Until all that is due within the duration was played, however late.
bool ServeSession::goes_on() const {
  if (*stopping_ || quit_) return false;
  return std::min({played_end(), player_.next(), now()}) < settings_.duration;
}

void ServeSession::await_reader() {
  while (!*stopping_ && !quit_ && port_.descriptor() < 0) wait(longest_wait);
}

void ServeSession::play() {
  const dsp::Seconds next = std::min(player_.next(), played_end());
  wait(std::min(on_the_wall(next - now()), longest_wait));
  const dsp::Seconds at = now();
  send(at);
  if (at < played_end()) return;
  report_message();
  begin_message();
  report_lag();
}

void ServeSession::begin_message() {
  while (!ahead_.is_ready(patience))
    if (*stopping_) return;
  origin_ += message_.end;
  message_ = ahead_.take();
  if (settings_.drop_framing_errors) std::erase_if(message_.bytes, has_no_stop_bit);
  player_.push(message_, origin_);
  ahead_.begin(scenario_.link(), ++next_);
}

/// A byte that begins with the message's last bit still is of this message.
dsp::Seconds ServeSession::played_end() const {
  const dsp::Seconds end = origin_ + message_.end;
  return message_.bytes.empty() ? end : std::max(end, origin_ + message_.bytes.back().at);
}

void ServeSession::send(dsp::Seconds now) {
  const protocol::Bytes bytes = player_.take_due(now);
  if (bytes.empty()) return;
  const std::size_t taken = port_.descriptor() < 0 ? 0 : port_.write(bytes);
  n_bytes_ += bytes.size();
  n_lost_of_message_ += bytes.size() - taken;
}

void ServeSession::report_message() {
  const LineVerdict verdict = decoder_.hear(message_);
  const std::uint64_t lost = std::exchange(n_lost_of_message_, 0);
  ++n_messages_;
  n_ok_ += verdict.outcome == "ok";
  n_lost_ += lost;
  if (messages_ == nullptr) return;
  messages_->check();
  if (!messages_->has_room()) {
    ++n_lines_lost_;
    return;
  }
  if (const auto n = std::exchange(n_lines_lost_, 0); n != 0) messages_->push(lost_lines(n));
  messages_->push(message_line(message_, origin_, verdict, lost));
}

/// What a reader sends goes nowhere: there is no light in its direction.
void ServeSession::wait(dsp::Seconds at_most) {
  std::array<pollfd, 2> ends{{{port_.descriptor(), POLLIN, 0}, {input_.descriptor(), POLLIN, 0}}};
  const timespec span = span_of(at_most);
  if (::ppoll(ends.data(), ends.size(), &span, nullptr) <= 0) return;
  if (ends[0].revents != 0) port_.read();
  if (ends[1].revents != 0)
    for (const std::string& line : input_.read()) heed(line);
}

void ServeSession::heed(const std::string& line) {
  try {
    if (line == "quit")
      quit_ = true;
    else if (line.size() > longest_line)
      throw bad_input("cannot read a line of stdin", "longer than 64 KiB", "write key=value");
    else if (!line.empty())
      change(line);
  } catch (const Failure& refusal) {
    say(std::string("cosys-sim: ") + refusal.what() + "\n");
  }
}

/// The message that is being made is made again.
void ServeSession::change(const std::string& key_and_value) {
  scenario_.set(key_and_value);
  ahead_.begin(scenario_.link(), next_);
  say(fmt::format("cosys-sim: {} from message {} on\n", escaped(key_and_value), next_));
}

void ServeSession::report_lag() {
  const dsp::Seconds lag = since_start() - on_the_wall(origin_);
  if (has_lagged_ || lag < noticeable) return;
  has_lagged_ = true;
  say(
      fmt::format("cosys-sim: the line is {:.2g} s late (the machine takes longer than --speed {} "
                  "allows) lower it; bytes keep their order\n",
                  lag.value, settings_.speed));
}

void ServeSession::report_end() const {
  say(fmt::format("cosys-sim: played: {} messages, {} of them ok; {} bytes, {} of them lost\n",
                  n_messages_, n_ok_, n_bytes_, n_lost_ + n_lost_of_message_));
}

}  // namespace sim
