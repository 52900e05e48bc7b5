#include "protocol/soft_line_finder.hpp"

#include <utility>

#include "protocol/cosys.hpp"

namespace protocol {
namespace {

/// Tried at each end: the oldest and the latest. Each that is tried may by chance have a right
/// checksum.
constexpr std::size_t most_starts = 3;

}  // namespace

std::vector<SoftMessage> SoftLineFinder::take(std::span<const SoftCharacter> characters,
                                              bool after_long_pause) {
  std::vector<SoftMessage> accepted;
  if (after_long_pause) may_begin_here();
  for (std::size_t i = 0; i < characters.size(); ++i) {
    add(characters[i]);
    const bool newline = characters[i].value() == '\n';
    if (!newline && i + 1 < characters.size()) continue;
    if (auto message = line_that_ends_here()) {
      accepted.push_back(*std::move(message));
      forget_before(pending_.size());
    }
    if (newline) may_begin_here();
  }
  return accepted;
}

void SoftLineFinder::add(const SoftCharacter& character) {
  if (pending_.size() == default_max_line)
    forget_before(starts_.size() > 1 ? starts_[1] : default_max_line);
  if (pending_.empty()) may_begin_here();
  pending_.push_back(character);
}

void SoftLineFinder::may_begin_here() {
  if (starts_.empty() || starts_.back() != pending_.size()) starts_.push_back(pending_.size());
}

std::optional<SoftMessage> SoftLineFinder::line_that_ends_here() {
  if (starts_.size() > most_starts)
    starts_.erase(starts_.begin() + 1, starts_.end() - (most_starts - 1));
  for (const std::size_t start : starts_) {
    auto message = judge_.judge(std::span(pending_).subspan(start));
    if (message) return message;
  }
  return std::nullopt;
}

void SoftLineFinder::forget_before(std::size_t character) {
  pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(character));
  std::erase_if(starts_, [=](std::size_t start) { return start < character; });
  for (std::size_t& start : starts_) start -= character;
}

}  // namespace protocol
