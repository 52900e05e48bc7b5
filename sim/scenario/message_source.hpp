#pragma once
// What a device of an arena says.
#include <span>
#include <string_view>

namespace sim {

enum class MessageSource { fixed, list, counter, status };

struct MessageSourceName {
  std::string_view name;
  MessageSource source;
};
std::span<const MessageSourceName> message_sources();
/// Of a name that is in the table.
MessageSource find_message_source(std::string_view name);

}  // namespace sim
