#include "sim/capture/text_mark.hpp"

#include "sim/failure.hpp"

namespace sim {

std::size_t mark_bytes(std::string_view text, const std::string& file) {
  constexpr std::string_view utf8 = "\xEF\xBB\xBF", utf16_le = "\xFF\xFE", utf16_be = "\xFE\xFF";
  if (text.starts_with(utf16_le) || text.starts_with(utf16_be))
    throw bad_input("cannot decode " + file, "it is UTF-16 text", "save it as UTF-8");
  return text.starts_with(utf8) ? utf8.size() : 0;
}

}  // namespace sim
