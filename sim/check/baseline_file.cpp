#include <algorithm>
#include <numeric>
#include <span>

#include "sim/check/baseline.hpp"
#include "sim/failure.hpp"
#include "sim/result/netcdf.hpp"
#include "sim/result/netcdf_reader.hpp"
#include "sim/text/new_file.hpp"

namespace sim {
namespace {

constexpr const char* file_type = "cosys-sim baseline";
constexpr const char* root = NetcdfFile::root;

std::string attribute_of_scenario(std::size_t i) { return "scenario_toml_" + std::to_string(i); }

std::size_t most_frames(const Baseline& baseline) {
  std::size_t most = 0;
  for (const BaselinePoint& point : baseline.points) most = std::max(most, point.frames.size());
  return most;
}

void add_dimensions(NetcdfFile& file, const Baseline& baseline) {
  std::vector<std::string> names;
  for (const BaselinePoint& point : baseline.points) names.push_back(point.name);
  file.add_dimension({"point", "", "scenario and point of its sweep"},
                     std::span<const std::string>(names));
  std::vector<double> numbers(most_frames(baseline));
  std::iota(numbers.begin(), numbers.end(), 0.0);
  file.add_dimension({"frame", "", "trial, as of trace --trial"}, std::span<const double>(numbers));
}

/// One number a point.
template <class Value>
void add_of_points(NetcdfFile& file, const Baseline& baseline, const VariableFacts& facts,
                   const Value& value) {
  std::vector<std::int64_t> values;
  for (const BaselinePoint& point : baseline.points)
    values.push_back(static_cast<std::int64_t>(value(point)));
  file.add_variable(facts, {"point"}, std::span<const std::int64_t>(values));
}

template <class Is>
auto count_frames(const Is& is) {
  return [=](const BaselinePoint& point) {
    return std::ranges::count_if(point.frames, is, &FrameRecord::outcome);
  };
}

void add_counts(NetcdfFile& file, const Baseline& baseline) {
  add_of_points(file, baseline, {"scenario", "", "which of the scenario_toml attributes"},
                [](const BaselinePoint& point) { return point.scenario; });
  add_of_points(file, baseline, {"physics", "", "hash of all that decides the light"},
                [](const BaselinePoint& point) { return point.physics; });
  add_of_points(file, baseline, {"n_frames", "", "frames sent"},
                [](const BaselinePoint& point) { return point.frames.size(); });
  add_of_points(file, baseline, {"n_frames_lost", "", "frames not delivered intact"},
                count_frames([](const FrameOutcome& o) { return o.lost(); }));
  add_of_points(file, baseline,
                {"n_frames_undetected", "", "frames in whose time another was accepted"},
                count_frames([](const FrameOutcome& o) { return o.undetected_error; }));
}

/// One value a frame; where a point has fewer frames, the last are empty.
template <class T, class Value>
void add_of_frames(NetcdfFile& file, const Baseline& baseline, const VariableFacts& facts,
                   const Value& value) {
  const std::size_t frames = most_frames(baseline);
  std::vector<T> values(baseline.points.size() * frames);
  for (std::size_t p = 0; p < baseline.points.size(); ++p)
    for (std::size_t f = 0; f < baseline.points[p].frames.size(); ++f)
      values[p * frames + f] = static_cast<T>(value(baseline.points[p].frames[f]));
  file.add_variable(facts, {"point", "frame"}, std::span<const T>(values));
}

void add_frames(NetcdfFile& file, const Baseline& baseline) {
  add_of_frames<std::uint8_t>(file, baseline, {"outcome", "", "what the decoder made of the frame"},
                              [](const FrameRecord& frame) { return as_bits(frame.outcome); });
  file.set_flags("outcome", {"delivered", "another_accepted", "unknown"});
  add_of_frames<std::int64_t>(file, baseline, {"light", "", "hash of the receiver's pin"},
                              [](const FrameRecord& frame) { return frame.light; });
}

std::string image_of(const Baseline& baseline) {
  NetcdfFile file(file_type, baseline.program);
  add_dimensions(file, baseline);
  add_counts(file, baseline);
  add_frames(file, baseline);
  file.set_user_text(root, "decoder", baseline.decoder);
  file.set_user_text(root, "command", baseline.command);
  for (std::size_t i = 0; i < baseline.scenarios.size(); ++i)
    file.set_user_text(root, attribute_of_scenario(i).c_str(), baseline.scenarios[i]);
  return file.image();
}

bool is_baseline(const std::filesystem::path& path) { return filetype_of(path) == file_type; }

// ---- reading ----

[[noreturn]] void refuse_damaged(const std::filesystem::path& path) {
  throw bad_input(path.string(), "damaged: its parts do not fit together",
                  "make it anew with cosys-sim baseline");
}

struct Numbers {
  std::vector<std::int64_t> scenario, physics, n_frames, n_frames_lost, outcome, light;
  std::size_t frames = 0;  // columns
};

Numbers numbers_of(const NetcdfReader& file) {
  return {.scenario = file.integers("scenario"),
          .physics = file.integers("physics"),
          .n_frames = file.integers("n_frames"),
          .n_frames_lost = file.integers("n_frames_lost"),
          .outcome = file.integers("outcome"),
          .light = file.integers("light"),
          .frames = file.integers("frame").size()};
}

/// 0, 0, 1, 2, 2: each scenario has points, and they are together.
bool are_in_order(const std::vector<std::int64_t>& scenarios) {
  std::int64_t last = -1;
  for (const std::int64_t scenario : scenarios) {
    if (scenario != last && scenario != last + 1) return false;
    last = scenario;
  }
  return last >= 0 && scenarios.front() == 0;
}

bool fit(const Numbers& numbers, std::size_t points) {
  const auto is_row = [&](std::int64_t n) {
    return n >= 0 && static_cast<std::uint64_t>(n) <= numbers.frames;
  };
  return numbers.scenario.size() == points && numbers.physics.size() == points &&
         numbers.n_frames.size() == points && numbers.n_frames_lost.size() == points &&
         numbers.outcome.size() == points * numbers.frames &&
         numbers.light.size() == numbers.outcome.size() &&
         std::ranges::all_of(numbers.n_frames, is_row) && are_in_order(numbers.scenario);
}

BaselinePoint point_of(const Numbers& numbers, std::size_t p) {
  BaselinePoint point{.name = {},
                      .scenario = static_cast<std::size_t>(numbers.scenario[p]),
                      .physics = static_cast<std::uint64_t>(numbers.physics[p]),
                      .frames = {}};
  for (std::size_t f = 0; f < static_cast<std::size_t>(numbers.n_frames[p]); ++f) {
    const std::size_t cell = p * numbers.frames + f;
    point.frames.push_back({outcome_of_bits(static_cast<unsigned>(numbers.outcome[cell])),
                            static_cast<std::uint64_t>(numbers.light[cell])});
  }
  return point;
}

std::int64_t lost(const BaselinePoint& point) {
  return count_frames([](const FrameOutcome& o) { return o.lost(); })(point);
}

}  // namespace

void write_baseline(const std::filesystem::path& path, const Baseline& baseline) {
  write_file(path, image_of(baseline));
}

Baseline read_baseline(const std::filesystem::path& path) {
  const NetcdfReader file(path);
  if (file.text("filetype", "") != file_type)
    throw bad_input(path.string(), "not a baseline of cosys-sim",
                    "make one with cosys-sim baseline");
  Baseline baseline{.program = {file.text("program"), file.text("version"), file.text("commit")},
                    .command = file.text("command"),
                    .decoder = file.text("decoder"),
                    .scenarios = {},
                    .points = {}};
  const std::vector<std::string> names = file.texts("point");
  const Numbers numbers = numbers_of(file);
  if (!fit(numbers, names.size())) refuse_damaged(path);
  for (std::size_t p = 0; p < names.size(); ++p) {
    baseline.points.push_back(point_of(numbers, p));
    baseline.points[p].name = names[p];
    if (lost(baseline.points[p]) != numbers.n_frames_lost[p]) refuse_damaged(path);
    while (baseline.scenarios.size() <= baseline.points[p].scenario)
      baseline.scenarios.push_back(
          file.text(attribute_of_scenario(baseline.scenarios.size()).c_str()));
  }
  return baseline;
}

void check_baseline_place(const std::filesystem::path& path) {
  check_place(path, {is_baseline, "a baseline of cosys-sim"});
}

}  // namespace sim
