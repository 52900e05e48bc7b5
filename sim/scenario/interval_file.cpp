#include "sim/scenario/interval_file.hpp"

#include <fmt/format.h>

#include <sstream>

#include "sim/failure.hpp"
#include "sim/text/list_text.hpp"
#include "sim/text/number_text.hpp"
#include "sim/text/text_file.hpp"

namespace sim {

std::string read_number_lines(const std::filesystem::path& path, const std::string& asked) {
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    throw bad_input(asked, "there is no file " + path.generic_string(), "correct the name");
  std::istringstream text(read_text_file(path, "list of pauses"));
  std::string list, line;
  for (int number = 1; std::getline(text, line); ++number) {
    if (line.ends_with('\r')) line.pop_back();
    const std::string_view value = trimmed(line);
    if (value.empty() || value.starts_with('#')) continue;
    if (!parse_number(value))
      throw bad_input(fmt::format("\"{}\" in {}:{}", value, path.generic_string(), number),
                      "not a number", "write one number a line");
    list += fmt::format("{}{}", list.empty() ? "" : ",", value);
  }
  if (list.empty())
    throw bad_input("in " + path.generic_string(), "no number in it", "write one number a line");
  return list;
}

}  // namespace sim
