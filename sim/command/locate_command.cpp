// `cosys-sim locate`: where readings of light, measured or drawn, say that a device is.
#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string_view>

#include "sim/command/commands.hpp"
#include "sim/components/parts.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/location/locate.hpp"
#include "sim/location/location_report.hpp"
#include "sim/location/location_settings.hpp"
#include "sim/location/readings_file.hpp"
#include "sim/text/new_file.hpp"
#include "sim/text/row_table.hpp"
#include "sim/text/standard_output.hpp"

namespace sim {
namespace {

constexpr std::string_view of_readings[] = {"--led",   "--led-current-ma",   "--led-yaw-deg",
                                            "--floor", "--photodiode",       "--height-mm",
                                            "--area",  "--unknown-intensity"};
constexpr std::string_view of_scenarios[] = {"--set", "--seed", "--point", "--trial"};

/// Options that would not be heeded.
void refuse_locating(std::span<const std::string_view> names, const LocateRequest& request,
                     const char* why) {
  for (const std::string_view name : names)
    if (std::ranges::find(request.given, name) != request.given.end())
      throw bad_input(fmt::format("{} with {}", name, request.readings.string()), why,
                      "leave it out");
}

LightModel model_of(const LocateRequest& request, const PartSources& parts,
                    const channel::PhotodiodeData& photodiode) {
  LightModel model;
  model.emitter = load_led(request.led, parts, "--led " + request.led).data;
  model.axial =
      channel::axial_intensity(model.emitter, dsp::Amperes(request.led_current_ma * 1e-3));
  model.led_height_m = request.height_mm * 1e-3;
  model.all_round = !request.led_yaw_deg;
  model.yaw = dsp::degrees(request.led_yaw_deg.value_or(0));
  model.directivity.cosine_power = channel::cosine_power(dsp::degrees(photodiode.half_angle_deg));
  model.floor = load_floor(request.floor, parts, "--floor " + request.floor).data;
  return model;
}

Location of_readings_file(const LocateRequest& request) {
  refuse_locating(of_scenarios, request, "readings are measured, not drawn");
  const PartSources parts{.folders = request.options.parts, .carried = {}, .carrier = {}};
  const channel::PhotodiodeData photodiode =
      load_photodiode(request.photodiode, parts, "--photodiode " + request.photodiode).data;
  LocateSettings settings;
  settings.model = model_of(request, parts, photodiode);
  if (request.area) settings.area = area_of(*request.area, "--area");
  settings.intensity_unknown = request.intensity_unknown;
  const MeasuredReadings measured =
      read_readings(request.readings, photodiode, request.height_mm * 1e-3);
  settings.deviations_are_shares = measured.deviations_are_shares;
  return locate(settings, measured.readings);
}

Location of_scenario(const LocateRequest& request) {
  refuse_locating(of_readings, request, "a scenario says it by a key");
  const LoadedScenario scenario = load_with(request.options, request.readings);
  if (scenario.base.experiment != "location")
    throw bad_input(request.readings.string(),
                    "an experiment \"" + scenario.base.experiment + "\" locates nothing",
                    "write experiment = \"location\" before the first table");
  return locate_trial(location_settings(numbered_point(scenario, request.point), scenario.places),
                      request.trial);
}

}  // namespace

ExitCode locate_command(const LocateRequest& request) {
  if (request.output)
    check_row_table(*request.output, {is_location_table, "a table of cosys-sim locate"});
  const bool is_scenario = request.readings.extension() == ".toml";
  const Location location = is_scenario ? of_scenario(request) : of_readings_file(request);
  if (request.output) write_file(*request.output, location_table(*request.output, location));
  request.json ? print_json(location_json(location)) : print(location_text(location));
  return location.outcome == LocateOutcome::located ? ExitCode::done : ExitCode::inconclusive;
}

}  // namespace sim
