#pragma once
// Readings of light as a CSV file: lines that begin with # and empty ones aside, the first names
// the columns, in any order, and each of the others is a reading. Columns: x_m, y_m, heading_deg;
// irradiance_mw_per_m2 (effective, of the lit carrier, ambient light taken off) or photocurrent_ua
// (of the photodiode, the same); sigma (in the unit of the reading) or relative_sigma (its share);
// if measured bearing_deg (from the heading, anticlockwise) and bearing_sigma_deg, empty where not.
#include <filesystem>
#include <vector>

#include "channel/photodiode.hpp"
#include "sim/location/light_model.hpp"

namespace sim {

struct MeasuredReadings {
  std::vector<Reading> readings;
  bool deviations_are_shares = false;  // relative_sigma
};

/// Throws bad_input that names the line for a file of another form. `height_m` is the receivers'.
MeasuredReadings read_readings(const std::filesystem::path& path,
                               const channel::PhotodiodeData& photodiode, double height_m);

}  // namespace sim
