#include "sim/columns/closing_lines.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace sim {

std::string unfinished_note(std::size_t all, std::size_t finished, std::size_t begun) {
  if (finished == all) return "";
  return fmt::format("unfinished: {} of {} points{}; what follows is of what was counted\n",
                     all - finished, all,
                     begun < all ? fmt::format(", {} of them not begun", all - begun) : "");
}

std::string left_out_note(const std::vector<std::string>& columns, const std::string& who_has_all) {
  if (columns.empty()) return "";
  return fmt::format("no room for {} ({} has all)\n", fmt::join(columns, ", "), who_has_all);
}

std::string shards_note(const std::vector<Shard>& shards) {
  if (are_all(shards)) return "";
  return fmt::format("shards {} of the trials: cosys-sim merge adds the others\n",
                     shards_text(shards));
}

std::string kept_line(const std::filesystem::path& place, const std::string& digest) {
  return fmt::format("{}: digest {}\n", place.string(), digest);
}

}  // namespace sim
