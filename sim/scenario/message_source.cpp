#include "sim/scenario/message_source.hpp"

#include <algorithm>
#include <array>

namespace sim {
namespace {

constexpr std::array source_names{MessageSourceName{"fixed", MessageSource::fixed},
                                  MessageSourceName{"list", MessageSource::list},
                                  MessageSourceName{"counter", MessageSource::counter},
                                  MessageSourceName{"status", MessageSource::status}};

}  // namespace

std::span<const MessageSourceName> message_sources() { return source_names; }

MessageSource find_message_source(std::string_view name) {
  return std::ranges::find(source_names, name, &MessageSourceName::name)->source;
}

}  // namespace sim
