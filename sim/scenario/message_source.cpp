#include "sim/scenario/message_source.hpp"

#include <algorithm>
#include <array>

namespace sim {
namespace {

constexpr std::array table{MessageSourceName{"fixed", MessageSource::fixed},
                           MessageSourceName{"list", MessageSource::list},
                           MessageSourceName{"counter", MessageSource::counter},
                           MessageSourceName{"status", MessageSource::status}};

}  // namespace

std::span<const MessageSourceName> message_sources() { return table; }

MessageSource find_message_source(std::string_view name) {
  return std::ranges::find(table, name, &MessageSourceName::name)->source;
}

}  // namespace sim
