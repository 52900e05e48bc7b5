#include "sim/columns/closing_lines.hpp"

#include <fmt/format.h>

namespace sim {

std::string unfinished_note(std::size_t all, std::size_t finished, std::size_t begun) {
  if (finished == all) return "";
  return fmt::format("unfinished: {} of {} points{}; what follows is of what was counted\n",
                     all - finished, all,
                     begun < all ? fmt::format(", {} of them not begun", all - begun) : "");
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
