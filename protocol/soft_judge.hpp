#pragma once
// Whether a line is believed. The XOR is weak: of all lines of random characters, each has one of
// right checksum within a bit or two of it. So what is accepted needs light that is nearly its own,
// few corrections, and every other line much further off; one that was heard a few seconds ago
// needs less of each, but it too must be the best of all.
#include <deque>
#include <optional>
#include <span>
#include <string>

#include "protocol/soft_characters.hpp"

namespace protocol {

struct SoftMessage {
  std::string message;
  dsp::Seconds start;     // of its first character
  bool repeated = false;  // would not have been accepted, had it not been heard before

  bool operator==(const SoftMessage&) const = default;
};

/// Whether a decoder believes more easily what it heard before.
enum class SoftMemory { none, of_messages };

class SoftJudge {
 public:
  explicit SoftJudge(SoftMemory memory) : remembers_(memory == SoftMemory::of_messages) {}

  /// Of characters that may be a line, its newline the last.
  std::optional<SoftMessage> judge(std::span<const SoftCharacter> characters);

 private:
  bool is_remembered(const std::string& message, dsp::Seconds now) const;
  void remember(const SoftMessage& message);

  bool remembers_;
  std::deque<SoftMessage> heard_;  // alone, the latest of each message; bounded
};

}  // namespace protocol
