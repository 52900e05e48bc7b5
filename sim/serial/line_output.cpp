#include "sim/serial/line_output.hpp"

#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <climits>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string_view>
#include <thread>
#include <utility>

#include "sim/failure.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/text/write_all.hpp"

namespace sim {
namespace {

constexpr std::size_t most_waiting = std::size_t{1} << 20U;
constexpr std::chrono::seconds patience(1);

}  // namespace

struct LineOutput::Queue {
  std::mutex mutex;
  std::condition_variable changed;
  std::deque<std::string> lines;
  std::size_t bytes = 0;  // of the lines, and of those that are being written
  bool closed = false, failed = false;
  int error = 0;  // the errno of the write that failed

  std::string take_lines();
  void write_to(int descriptor);
  /// Waits for the reader as long as it reads, but not a second time.
  void close();
};

/// As many as a pipe takes in one piece, so that other processes' lines do not get into them.
std::string LineOutput::Queue::take_lines() {
  std::string text;
  do {
    text += lines.front();
    lines.pop_front();
  } while (!lines.empty() && text.size() + lines.front().size() <= PIPE_BUF);
  return text;
}

void LineOutput::Queue::write_to(int descriptor) {
  std::unique_lock lock(mutex);
  while (!failed) {
    changed.wait(lock, [&] { return closed || !lines.empty(); });
    if (lines.empty()) return;
    const std::string text = take_lines();
    lock.unlock();
    const bool written = write_all(descriptor, text);
    const int reason = errno;
    lock.lock();
    if (written) bytes -= text.size();
    if (!written) error = reason;
    failed = !written;
    changed.notify_all();
  }
}

void LineOutput::Queue::close() {
  std::unique_lock lock(mutex);
  if (closed) return;
  for (std::size_t left = 0; !failed && bytes != 0 && bytes != left;) {
    left = bytes;
    changed.wait_for(lock, patience, [&] { return failed || bytes != left; });
  }
  closed = true;
  changed.notify_all();
}

LineOutput::LineOutput(int descriptor) : queue_(std::make_shared<Queue>()) {
  std::thread([queue = queue_, descriptor] { queue->write_to(descriptor); }).detach();
}

LineOutput::~LineOutput() { queue_->close(); }

bool LineOutput::has_room() const {
  const std::lock_guard lock(queue_->mutex);
  return queue_->bytes < most_waiting;
}

void LineOutput::push(std::string line) {
  const std::lock_guard lock(queue_->mutex);
  queue_->bytes += line.size();
  queue_->lines.push_back(std::move(line));
  queue_->changed.notify_all();
}

void LineOutput::check() const {
  const std::lock_guard lock(queue_->mutex);
  if (queue_->failed) throw unwritable_output(queue_->error);
}

void LineOutput::finish() {
  queue_->close();
  check();
  const std::lock_guard lock(queue_->mutex);
  if (queue_->bytes != 0)
    throw Failure(ExitCode::environment,
                  "standard output was not read to its end (its reader stalled) read it, or "
                  "redirect it to a file");
}

}  // namespace sim
