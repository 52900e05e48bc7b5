#include "sim/report/closing_lines.hpp"

#include <fmt/format.h>

#include "sim/report/report_table.hpp"

namespace sim {

std::string shards_note(const std::vector<Shard>& shards) {
  if (are_all(shards)) return "";
  return fmt::format("shards {} of the trials: cosys-sim merge adds the others\n",
                     shards_text(shards));
}

std::string missing_lines(const ExperimentResult& result) {
  return unfinished_note(result) + shards_note(result.shards);
}

std::string closing_lines(const ExperimentResult& result, const std::filesystem::path& kept_in,
                          const CrossingQuestion& question) {
  return mark_notes(result) + loss_reasons(result) + ranking_lines(result, rank(result, question)) +
         fmt::format("{}: digest {}\n", kept_in.string(), result_digest(result));
}

}  // namespace sim
