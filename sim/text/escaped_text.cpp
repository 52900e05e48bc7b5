#include "sim/text/escaped_text.hpp"

#include <fmt/format.h>

#include "protocol/ascii.hpp"

namespace sim {

std::string escaped(std::string_view text) {
  std::string shown;
  for (const char c : text) {
    if (c == '\\')
      shown += "\\\\";
    else if (protocol::is_printable(c))
      shown += c;
    else
      shown += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  }
  return shown;
}

}  // namespace sim
