// `cosys-sim fit --plan`: what it takes to measure a receiver module.
#include <fmt/format.h>

#include <deque>
#include <vector>

#include "sim/command/commands.hpp"
#include "sim/components/parts.hpp"
#include "sim/fit/arduino_sketch.hpp"
#include "sim/fit/bench_notes.hpp"
#include "sim/fit/plan_schedule.hpp"
#include "sim/fit/plan_text.hpp"
#include "sim/fit/wiring_picture.hpp"
#include "sim/text/existing_file.hpp"
#include "sim/text/new_file.hpp"
#include "sim/text/standard_output.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

struct BenchFile {
  fs::path place;
  std::string text;
};

constexpr const char* bench_led = "TSAL6200";

std::vector<BenchFile> bench_files(const FitRequest& request) {
  const PartSources parts{.folders = request.parts, .carried = {}, .carrier = {}};
  const channel::ModuleData like =
      load_module(request.module, parts, "--module " + request.module).data;
  const channel::EmitterData led = load_led(bench_led, parts, bench_led).data;
  const BenchSchedule schedule = schedule_for(like, led, request.minutes);
  const double distance_m = bench_distance_m(like, led);
  const fs::path& folder = *request.output;
  return {{folder / "plan.txt",
           plan_text(plan_of(schedule), bench_remarks(like.name, bench_first_level(like)))},
          {folder / "sketch" / "sketch.ino", arduino_sketch(schedule, like.name)},
          {folder / "wiring.svg", wiring_as_svg(like.name, distance_m)},
          {folder / "README.txt", bench_notes(schedule, like.name, distance_m)}};
}

/// A plan is lost that something was recorded of, or a sketch that somebody has changed.
void refuse_to_replace(const BenchFile& file) {
  std::error_code error;
  if (!fs::exists(file.place, error)) return;
  if (fs::is_regular_file(file.place, error) && fs::file_size(file.place, error) == 0) return;
  if (beginning_of(file.place, file.text.size() + 1) != file.text)
    throw bad_input("cannot write " + file.place.string(), "another one is there",
                    "choose another folder, or remove it");
}

/// All of them or none.
void write_bench(const std::vector<BenchFile>& all) {
  for (const BenchFile& file : all) refuse_to_replace(file);
  for (const BenchFile& file : all) make_folder(file.place.parent_path());
  std::deque<NewFile> files;
  for (const BenchFile& file : all) files.emplace_back(file.place).write(file.text);
  take_places(files);
}

}  // namespace

ExitCode bench_command(const FitRequest& request) {
  const std::vector<BenchFile> files = bench_files(request);
  write_bench(files);
  for (const BenchFile& file : files) print(file.place.string() + "\n");
  return ExitCode::done;
}

}  // namespace sim
