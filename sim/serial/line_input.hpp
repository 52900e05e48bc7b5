#pragma once
// LineInput: the lines that come through a descriptor, read as they come; reading never waits for
// the rest of one.
#include <cstddef>
#include <string>
#include <vector>

namespace sim {

class LineInput {
 public:
  /// The descriptor stays its owner's.
  LineInput(int descriptor, std::size_t longest) : descriptor_(descriptor), longest_(longest) {}

  /// To be polled; -1 behind the end.
  int descriptor() const { return descriptor_; }
  /// What has come, without line ends (LF or CR LF), after a poll that said so. Of a line longer
  /// than the limit one byte more than that. At the end, what was begun.
  std::vector<std::string> read();

 private:
  void take(char c, std::vector<std::string>& lines);
  void end_line(std::vector<std::string>& lines);

  int descriptor_;
  std::size_t longest_;
  std::string begun_;
};

}  // namespace sim
