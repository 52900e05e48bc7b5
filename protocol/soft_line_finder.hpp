#pragma once
// Where lines begin and end among soft characters. Newlines tell, as to a plain decoder; but one
// may be hit, so a line may also end before a pause and begin behind a long one, and a newline may
// have been another character.
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "protocol/soft_judge.hpp"

namespace protocol {

class SoftLineFinder {
 public:
  explicit SoftLineFinder(SoftMemory memory) : judge_(memory) {}

  /// What is accepted of the characters between two pauses, with those before as far as they belong
  /// to no message yet. `after_long_pause`: a line may begin with them.
  std::vector<SoftMessage> take(std::span<const SoftCharacter> characters, bool after_long_pause);

 private:
  void add(const SoftCharacter& character);
  void may_begin_here();
  std::optional<SoftMessage> line_that_ends_here();
  void forget_before(std::size_t character);

  SoftJudge judge_;
  std::vector<SoftCharacter> pending_;  // at most the longest line
  std::vector<std::size_t> starts_;     // among them, rising: where a line may begin
};

}  // namespace protocol
