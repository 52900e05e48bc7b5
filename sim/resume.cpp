#include "sim/resume.hpp"

#include <algorithm>
#include <string>

#include "sim/engine.hpp"
#include "sim/failure.hpp"
#include "sim/netcdf.hpp"
#include "sim/netcdf_reader.hpp"

namespace sim {
namespace {

/// Puts one column of the file into the points.
struct ColumnReader {
  const NetcdfReader& file;
  const char* name;
  std::vector<PointResult>& points;

  void operator()(std::uint64_t Tally::*count) const {
    each([=](PointResult& p, std::int64_t value) {
      p.tally.*count = static_cast<std::uint64_t>(value);
    });
  }
  void operator()(std::uint64_t PointResult::*count) const {
    each([=](PointResult& p, std::int64_t value) { p.*count = static_cast<std::uint64_t>(value); });
  }
  void operator()(StopReason PointResult::*flag) const {
    each([=](PointResult& p, std::int64_t value) {
      p.*flag = value == missing_int16 ? StopReason::interrupted : static_cast<StopReason>(value);
    });
  }
  /// Rates follow from the counts, the operating point from the scenario; costs are read apart.
  void operator()(Column::Real) const {}

 private:
  template <class Set>
  void each(const Set& set) const {
    const std::vector<std::int64_t> values = file.integers(name);
    for (std::size_t i = 0; i < std::min(points.size(), values.size()); ++i)
      set(points[i], values[i]);
  }
};

void read_costs(const NetcdfReader& file, std::vector<PointResult>& points) {
  const std::vector<double> elapsed = file.reals("elapsed_s");
  const std::vector<double> simulated = file.reals("simulated_s");
  for (std::size_t i = 0; i < std::min(points.size(), elapsed.size()); ++i) {
    points[i].elapsed_s = elapsed[i];
    points[i].simulated_s = simulated.at(i);
  }
}

void refuse(const std::filesystem::path& path, const std::string& why) {
  throw bad_input("cannot resume " + path.string(), why,
                  "leave out --resume to start anew, or name another -o");
}

void check_same_experiment(const std::filesystem::path& path, const NetcdfReader& file,
                           const ProgramInfo& program, const ExperimentResult& result) {
  if (file.text("format_version") != NetcdfFile::format_version)
    refuse(path, "it has another version of the format");
  if (file.text("version") != program.version || file.text("commit") != program.commit)
    refuse(path, "another version of the program counted it");
  if (file.whole_number("seed") != result.seed) refuse(path, "it has another seed");
  if (file.text("scenario_toml") != result.scenario_toml)
    refuse(path, "it is of another scenario, or of other options");
}

}  // namespace

void read_counts(const std::filesystem::path& path, const ProgramInfo& program,
                 ExperimentResult& result) {
  const NetcdfReader file(path);
  check_same_experiment(path, file, program, result);
  for (const Column& column : columns())
    std::visit(ColumnReader{file, column.name, result.points}, column.value);
  read_costs(file, result.points);
  const bool whole = std::ranges::all_of(result.points, [](const PointResult& p) {
    return p.stop != StopReason::interrupted || is_resumable(p);
  });
  if (!whole || result_digest(result) != file.text("result_digest"))
    refuse(path, "its counts do not fit its digest: it is damaged");
}

}  // namespace sim
