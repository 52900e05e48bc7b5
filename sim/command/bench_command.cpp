// `cosys-sim fit --plan`: what it takes to measure a receiver module.
#include <fmt/format.h>

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

constexpr const char* bench_led = "TSAL6200";

std::vector<WholeFile> bench_files(const FitRequest& request) {
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
void refuse_to_replace(const WholeFile& file) {
  std::error_code error;
  if (!fs::exists(file.place, error)) return;
  if (fs::is_regular_file(file.place, error) && fs::file_size(file.place, error) == 0) return;
  if (beginning_of(file.place, file.text.size() + 1) != file.text)
    throw bad_input("cannot write " + file.place.string(), "another one is there",
                    "choose another folder, or remove it");
}

}  // namespace

ExitCode bench_command(const FitRequest& request) {
  const std::vector<WholeFile> files = bench_files(request);
  for (const WholeFile& file : files) refuse_to_replace(file);
  write_files(files);
  for (const WholeFile& file : files) print(file.place.string() + "\n");
  return ExitCode::done;
}

}  // namespace sim
