// `cosys-sim locate`: where readings of light say that a device is.
#include "sim/commands.hpp"
#include "sim/location/locate.hpp"
#include "sim/location/location_report.hpp"
#include "sim/location/readings_file.hpp"
#include "sim/parts.hpp"
#include "sim/standard_output.hpp"

namespace sim {
namespace {

std::optional<Area> area_of(const LocateRequest& request) {
  if (!request.area) return std::nullopt;
  const std::vector<double>& a = *request.area;
  if (a[0] >= a[1] || a[2] >= a[3])
    throw bad_input("--area", "each range goes up", "write x from,to and y from,to: -3,3,0,5");
  return Area{a[0], a[1], a[2], a[3]};
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

}  // namespace

ExitCode locate_command(const LocateRequest& request) {
  const PartSources parts{.folders = request.parts, .carried = {}, .carrier = {}};
  const channel::PhotodiodeData photodiode =
      load_photodiode(request.photodiode, parts, "--photodiode " + request.photodiode).data;
  LocateSettings settings;
  settings.model = model_of(request, parts, photodiode);
  settings.area = area_of(request);
  settings.intensity_unknown = request.intensity_unknown;
  const Location location =
      locate(settings, read_readings(request.readings, photodiode, request.height_mm * 1e-3));
  print(request.json ? location_json(location) : location_text(location));
  return location.outcome == LocateOutcome::located ? ExitCode::done : ExitCode::inconclusive;
}

}  // namespace sim
