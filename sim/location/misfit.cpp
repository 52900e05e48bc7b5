#include "sim/location/misfit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sim {
namespace {

constexpr double ray_step = 1e-5;  // of the distance

MisfitRow intensity_row(const LightModel& model, const Reading& reading,
                        const ScatteredLight& scattered, std::size_t i, const Unknowns& u) {
  const double h = ray_step * distance(u.at, reading.place());
  const auto rays = [&](double dx, double dy) {
    return ray_light(model, {u.at.x + dx, u.at.y + dy}, reading.receiver);
  };
  const double light = rays(0, 0) + scattered.of(i, u.at);
  const double by_x = (rays(h, 0) - rays(-h, 0)) / (2 * h) + scattered.at[i].by_x;
  const double by_y = (rays(0, h) - rays(0, -h)) / (2 * h) + scattered.at[i].by_y;
  const double unit = 1 / reading.deviation_w_per_m2;
  return {.misfit = (reading.irradiance_w_per_m2 - u.intensity * light) * unit,
          .slope = {u.intensity * by_x * unit, u.intensity * by_y * unit, light * unit}};
}

MisfitRow bearing_row(const Reading& reading, const Position& device) {
  const double dx = device.x - reading.receiver.x, dy = device.y - reading.receiver.y;
  const double unit = 1 / reading.bearing_deviation.value;
  const double squared = dx * dx + dy * dy;
  return {.misfit = -bearing_error(reading, device) * unit,
          .slope = {-dy / squared * unit, dx / squared * unit, 0}};
}

}  // namespace

std::vector<MisfitRow> misfit_rows(const LightModel& model, const std::vector<Reading>& readings,
                                   const ScatteredLight& scattered, const Unknowns& unknowns) {
  std::vector<MisfitRow> rows;
  for (std::size_t i = 0; i < readings.size(); ++i)
    rows.push_back(intensity_row(model, readings[i], scattered, i, unknowns));
  for (const Reading& reading : readings)
    if (reading.has_bearing()) rows.push_back(bearing_row(reading, unknowns.at));
  return rows;
}

double chi_square(const LightModel& model, const std::vector<Reading>& readings,
                  const ScatteredLight& scattered, const Unknowns& unknowns) {
  double sum = 0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const Reading& reading = readings[i];
    const double light =
        ray_light(model, unknowns.at, reading.receiver) + scattered.of(i, unknowns.at);
    const double misfit =
        (reading.irradiance_w_per_m2 - unknowns.intensity * light) / reading.deviation_w_per_m2;
    sum += misfit * misfit;
    if (!reading.has_bearing()) continue;
    const double turned = bearing_error(reading, unknowns.at) / reading.bearing_deviation.value;
    sum += turned * turned;
  }
  return sum;
}

double bearing_error(const Reading& reading, const Position& device) {
  const double direction = std::atan2(device.y - reading.receiver.y, device.x - reading.receiver.x);
  const double bearing = direction - reading.receiver.yaw.value;
  return std::remainder(bearing - reading.bearing.value, 2 * std::numbers::pi);
}

double nearest_receiver(const std::vector<Reading>& readings, const Position& device) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Reading& reading : readings)
    nearest = std::min(nearest, distance(reading.place(), device));
  return nearest;
}

}  // namespace sim
