#pragma once
// Which message a device sends next.
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dsp/random_stream.hpp"
#include "dsp/units.hpp"
#include "sim/scenario/message_source.hpp"

namespace sim {

/// A digit count that a counter adds to its message, with a space before it.
inline constexpr std::size_t counter_size = 7;

/// The messages of one device in one run, asked for in the order of time.
class MessageQueue {
 public:
  /// `messages` must not be empty and outlive this. `hold`: mean time that a status lasts.
  MessageQueue(MessageSource source, std::span<const std::string> messages, dsp::Seconds hold,
               const dsp::RandomAddress& draws);

  /// What is sent at `now`.
  std::string next(dsp::Seconds now);

 private:
  void change_until(dsp::Seconds now);

  MessageSource source_;
  std::span<const std::string> messages_;
  dsp::Seconds hold_;
  dsp::RandomStream draws_;
  std::uint64_t sent_ = 0;
  std::size_t status_ = 0;
  std::optional<dsp::Seconds> status_until_{};  // nothing: never asked
};

}  // namespace sim
