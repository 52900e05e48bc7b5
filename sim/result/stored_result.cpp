#include "sim/result/stored_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "sim/failure.hpp"
#include "sim/loading/load_scenario.hpp"
#include "sim/result/netcdf.hpp"
#include "sim/result/unfinished.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/text/input_file.hpp"

namespace sim {
namespace {

/// Puts one column of the file into the points. False where it does not have a cell for each of
/// them, or a cell that no file of ours has.
struct ColumnReader {
  const NetcdfReader& file;
  const char* name;
  std::vector<PointResult>& points;

  bool operator()(std::uint64_t Tally::*count) const {
    return each([=](PointResult& p, std::int64_t value) {
      p.tally.*count = static_cast<std::uint64_t>(value);
      return true;
    });
  }
  /// Flags and alarms follow from the rest too; old files have fewer of them.
  bool operator()(std::uint64_t PointResult::*count) const {
    if (count == &PointResult::validity_flags || count == &PointResult::alarms) return true;
    return each([=](PointResult& p, std::int64_t value) {
      p.*count = static_cast<std::uint64_t>(value);
      return true;
    });
  }
  bool operator()(StopReason PointResult::*flag) const {
    return each([=](PointResult& p, std::int64_t value) {
      p.*flag = value == missing_int16 ? StopReason::interrupted : static_cast<StopReason>(value);
      return value == missing_int16 || (value >= 0 && value < std::ssize(stop_reason_names()));
    });
  }
  /// Only files of importance sampling have them.
  bool operator()(LinkColumn::Sum sum) const {
    if (!file.has(name)) return true;
    const std::vector<double> values = file.reals(name);
    if (values.size() != points.size()) return false;
    for (std::size_t i = 0; i < points.size(); ++i) sum(points[i].tally.weighted) = values[i];
    return true;
  }
  /// Rates follow from the counts, the operating point from the scenario; costs are read apart.
  bool operator()(LinkColumn::Real) const { return true; }

 private:
  template <class Set>
  bool each(const Set& set) const {
    const std::vector<std::int64_t> values = file.integers(name);
    if (values.size() != points.size()) return false;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (!set(points[i], values[i])) return false;
    return true;
  }
};

bool read_costs(const NetcdfReader& file, std::vector<PointResult>& points) {
  const std::vector<double> elapsed = file.reals("elapsed_s");
  const std::vector<double> simulated = file.reals("simulated_s");
  if (elapsed.size() != points.size() || simulated.size() != points.size()) return false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].elapsed_s = elapsed[i];
    points[i].simulated_s = simulated[i];
  }
  return true;
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

bool read_counts(const NetcdfReader& file, ExperimentResult& result) {
  const bool whole = std::ranges::all_of(columns(), [&](const LinkColumn& column) {
    return std::visit(ColumnReader{file, column.name, result.points}, column.value);
  });
  const auto shards = shards_of(file);
  result.shards = shards.value_or(std::vector<Shard>());
  return whole && shards && read_costs(file, result.points) &&
         result_digest(result) == file.text("result_digest");
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
