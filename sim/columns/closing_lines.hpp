#pragma once
// What is said below a table of points, whatever experiment they are of.
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/counting/shard.hpp"

namespace sim {

/// How many points a stopped run left unfinished; empty if none.
std::string unfinished_note(std::size_t all, std::size_t finished, std::size_t begun);

/// Which columns a table has no room for, and who has them; empty if none.
std::string left_out_note(const std::vector<std::string>& columns, const std::string& who_has_all);

/// Which trials or runs of all these are; empty if none is missing.
std::string shards_note(const std::vector<Shard>& shards);

/// Where a result is kept, with its digest.
std::string kept_line(const std::filesystem::path& place, const std::string& digest);

}  // namespace sim
