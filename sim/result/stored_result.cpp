#include "sim/result/stored_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "sim/counting/tally_counters.hpp"
#include "sim/failure.hpp"
#include "sim/loading/load_scenario.hpp"
#include "sim/result/netcdf.hpp"
#include "sim/result/unfinished.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/text/input_file.hpp"

namespace sim {
namespace {

using Points = std::vector<LinkPoint>;

/// Puts the cells of a variable into the points. False where it does not have one for each of them,
/// or `set` says that no file of ours has such a cell.
template <class Cell, class Set>
bool put(const std::vector<Cell>& cells, Points& points, const Set& set) {
  if (cells.size() != points.size()) return false;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!set(points[i], cells[i])) return false;
  return true;
}

bool read_counter(const NetcdfReader& file, Points& points, const TallyCounter& counter) {
  return put(file.integers(counter.name), points, [&](LinkPoint& p, std::int64_t value) {
    p.tally.*counter.count = static_cast<std::uint64_t>(value);
    return true;
  });
}

/// Only files of importance sampling have them.
bool read_weights(const NetcdfReader& file, Points& points, const WeightCounter& counter) {
  return !file.has(counter.name) ||
         put(file.reals(counter.name), points, [&](LinkPoint& p, double value) {
           counter.sum(p.tally.weighted) = value;
           return true;
         });
}

bool read_stop_reasons(const NetcdfReader& file, Points& points) {
  return put(file.integers("stop_reason"), points, [](LinkPoint& p, std::int64_t value) {
    p.stop = value == missing_int16 ? StopReason::interrupted : static_cast<StopReason>(value);
    return value == missing_int16 || (value >= 0 && value < std::ssize(stop_reason_names()));
  });
}

bool read_cost(const NetcdfReader& file, Points& points, const char* name,
               double LinkPoint::*cost) {
  return put(file.reals(name), points,
             [&](LinkPoint& p, double value) { return p.*cost = value, true; });
}

bool read_samples(const NetcdfReader& file, Points& points) {
  return put(file.integers("n_samples"), points, [](LinkPoint& p, std::int64_t value) {
    return p.n_samples = static_cast<std::uint64_t>(value), true;
  });
}

/// Rates follow from the counts; the operating point, flags and alarms from the scenario too.
bool read_points(const NetcdfReader& file, Points& points) {
  const auto counter = [&](const TallyCounter& c) { return read_counter(file, points, c); };
  const auto weights = [&](const WeightCounter& c) { return read_weights(file, points, c); };
  return std::ranges::all_of(tally_counters(), counter) &&
         std::ranges::all_of(weight_counters(), weights) && read_stop_reasons(file, points) &&
         read_cost(file, points, "elapsed_s", &LinkPoint::elapsed_s) &&
         read_cost(file, points, "simulated_s", &LinkPoint::simulated_s) &&
         read_samples(file, points);
}

/// Puts counts, reasons, costs and shards of the file into `result`, which has the points of its
/// sweep. False if they do not fit the sweep, or the digest that the file has of them.
bool read_counts(const NetcdfReader& file, LinkResult& result) {
  const auto shards = shards_of(file);
  result.shards = shards.value_or(std::vector<Shard>());
  return shards && read_points(file, result.points) &&
         result_digest(result) == file.text("result_digest");
}

}  // namespace

Origin origin_of(const NetcdfReader& file) {
  return {.format_version = file.text("format_version"),
          .program = {file.text("program"), file.text("version"), file.text("commit")},
          .seed = file.whole_number("seed"),
          .scenario_toml = file.text("scenario_toml")};
}

std::optional<std::vector<Shard>> shards_of(const NetcdfReader& file) {
  return parse_shards(file.text("shards", "1/1"));
}

std::string mismatch(const Origin& own, const Origin& other) {
  if (other.format_version != own.format_version) return "it has another version of the format";
  if (other.program.version != own.program.version || other.program.commit != own.program.commit)
    return "another version of the program counted it";
  if (other.seed != own.seed) return "it has another seed";
  if (other.scenario_toml != own.scenario_toml)
    return "it is of another scenario, or of other options";
  return "";
}

namespace {

/// Who reads a result cannot mend its scenario.
LoadedScenario carried_scenario(const Origin& origin, const std::filesystem::path& path) {
  try {
    return parse_scenario(origin.scenario_toml, path, {}, {});
  } catch (const Failure&) {
    throw bad_input(path.string(),
                    "the scenario in it cannot be read: it is damaged, or of another version",
                    "choose another file");
  }
}

/// "1.3" as 1, 3; of what is no version 0, 0.
std::pair<int, int> version_numbers(const std::string& version) {
  int major = 0, minor = 0;
  char dot = ' ';
  std::istringstream text(version);
  if (!(text >> major >> dot >> minor) || dot != '.') return {0, 0};
  return {major, minor};
}

void refuse_newer(const Origin& origin, const std::filesystem::path& path) {
  const std::string own = NetcdfFile::format_version;
  if (version_numbers(origin.format_version) <= version_numbers(own)) return;
  throw bad_input(path.string(),
                  fmt::format("its format {} is newer than {}, the newest known here",
                              origin.format_version, own),
                  "read it with the cosys-sim that wrote it, or a later one");
}

}  // namespace

LoadedScenario readable_scenario(const Origin& origin, const std::filesystem::path& path) {
  refuse_newer(origin, path);
  return carried_scenario(origin, path);
}

StoredResult read_result(const std::filesystem::path& path) {
  refuse_no_file(path, "result");
  const std::string type = filetype_of(path);
  if (type == experiment_result_type)
    throw bad_input(path.string(), "a result of another experiment than a link",
                    "give results of links");
  if (type != link_result_type)
    throw bad_input(path.string(), "not a result of cosys-sim, or damaged",
                    "give a file that run wrote");
  const NetcdfReader file(path);
  StoredResult stored{origin_of(file), {}, {}};
  stored.scenario = readable_scenario(stored.origin, path);
  stored.result = unfinished(stored.scenario, file.text("command"));
  stored.result.scenario_toml = stored.origin.scenario_toml;
  if (!read_counts(file, stored.result))
    throw bad_input(path.string(), "its counts do not fit its digest: it is damaged",
                    "choose another file");
  return stored;
}

}  // namespace sim
