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
#include "sim/picture/svg.hpp"
#include "sim/text/new_file.hpp"
#include "sim/text/standard_output.hpp"

namespace sim {
namespace {

struct BenchFile {
  std::filesystem::path place;
  std::string text;
  OwnFiles own;
};

constexpr const char* bench_led = "TSAL6200";

std::vector<BenchFile> bench_files(const FitRequest& request) {
  const PartSources parts{.folders = request.parts, .carried = {}, .carrier = {}};
  const channel::ModuleData like =
      load_module(request.module, parts, "--module " + request.module).data;
  const channel::EmitterData led = load_led(bench_led, parts, bench_led).data;
  const BenchSchedule schedule = schedule_for(like, led, request.minutes);
  const double distance_m = bench_distance_m(like, led);
  const std::filesystem::path& folder = *request.output;
  return {{folder / "plan.txt",
           plan_text(plan_of(schedule), bench_remarks(like.name, bench_first_level(like))),
           {is_written_plan, "a plan of cosys-sim"}},
          {folder / "sketch" / "sketch.ino",
           arduino_sketch(schedule, like.name),
           {is_written_sketch, "a sketch of cosys-sim"}},
          {folder / "wiring.svg",
           wiring_as_svg(like.name, distance_m),
           {is_drawing, "a picture of cosys-sim"}},
          {folder / "README.txt",
           bench_notes(schedule, like.name, distance_m),
           {is_written_notes, "of a bench of cosys-sim"}}};
}

/// All of them or none.
void write_bench(const std::vector<BenchFile>& all) {
  for (const BenchFile& file : all) refuse_to_lose(file.place, file.own);
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
