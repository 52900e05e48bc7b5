#pragma once
// LineOutput: lines on their way to a descriptor whose reader may stall. Only a thread of its own
// waits for that reader. O_NONBLOCK would hold for all processes that have the same file open, and
// what poll promises of a write is another thing for pipes, sockets and terminals.
#include <cstddef>
#include <memory>
#include <string>

namespace sim {

class LineOutput {
 public:
  /// The descriptor stays its owner's.
  explicit LineOutput(int descriptor);
  LineOutput(const LineOutput&) = delete;
  LineOutput& operator=(const LineOutput&) = delete;
  /// Waits as finish() does, but complains of nothing.
  ~LineOutput();

  /// Whether less than the limit, a megabyte, waits to be read.
  bool has_room() const;
  /// A line with its end, in any case. Lines are written whole, as far as pipes can do that.
  void push(std::string line);
  /// Throws unwritable_output() if the descriptor takes no more for good.
  void check() const;
  /// The end: waits until the reader has all, or has taken nothing for a second. Throws, as check()
  /// or Failure(environment), if not all was taken.
  void finish();

 private:
  struct Queue;

  std::shared_ptr<Queue> queue_;  // the thread's too, which may have to be left behind
};

}  // namespace sim
