#include "protocol/soft_judge.hpp"

#include <algorithm>

#include "protocol/cosys.hpp"
#include "protocol/soft_line.hpp"

namespace protocol {
namespace {

using dsp::Seconds;

/// In bits of mismatch.
struct Limits {
  double corrected;             // at most
  double margin;                // at least
  double mismatch_a_character;  // at most
};

/// Corrected: what noise took of one bit, and half another. Margin: two bits in one column are
/// wrong only if they are as good as known, together: of 27 wrong lines that a margin of 0.5
/// accepted of 4000 damaged ones, 0.9 accepts two. Mismatch: noise has 2 a character and more.
constexpr Limits alone{.corrected = 1.5, .margin = 0.9, .mismatch_a_character = 0.6};
/// A line that was heard before is far likelier than any other, but must be the best still.
constexpr Limits repeated{.corrected = 3, .margin = 0.2, .mismatch_a_character = 1};

/// Devices repeat their message every 100 to 900 ms (COSYS protocol): five of the longest intervals
/// with their messages.
constexpr Seconds remembered_for(6);

/// Devices that are heard at a time, or states of one.
constexpr std::size_t most_remembered = 8;

bool is_within(const Limits& limits, const SoftLine& line, std::size_t characters) {
  return line.corrected <= limits.corrected && line.margin >= limits.margin &&
         line.mismatch <= limits.mismatch_a_character * static_cast<double>(characters);
}

}  // namespace

std::optional<SoftMessage> SoftJudge::judge(std::span<const SoftCharacter> characters) {
  const SoftLine line = best_line(characters);
  if (!is_within(repeated, line, characters.size()) || problem_in_message(line.message))
    return std::nullopt;
  SoftMessage message{.message = line.message, .start = characters.front().start};
  if (is_within(alone, line, characters.size())) {
    remember(message);
    return message;
  }
  message.repeated = true;
  if (!is_remembered(message.message, message.start)) return std::nullopt;
  return message;
}

bool SoftJudge::is_remembered(const std::string& message, Seconds now) const {
  return std::ranges::any_of(heard_, [&](const SoftMessage& heard) {
    return heard.message == message && now - heard.start < remembered_for;
  });
}

void SoftJudge::remember(const SoftMessage& message) {
  if (!remembers_) return;
  std::erase_if(heard_, [&](const auto& heard) { return heard.message == message.message; });
  heard_.push_back(message);
  if (heard_.size() > most_remembered) heard_.pop_front();
}

}  // namespace protocol
