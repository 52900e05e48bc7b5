#pragma once
// How far readings are from what the model predicts for a device somewhere, in their deviations,
// and how that changes with the unknowns: what least squares works on.
#include <array>
#include <vector>

#include "sim/location/light_model.hpp"

namespace sim {

struct Unknowns {
  Position at;
  double intensity = 1;  // factor to the model's
};

/// One measured number: (measured - predicted) / deviation, and what that loses by each unknown: x
/// and y in metres, then the factor.
struct MisfitRow {
  double misfit = 0;
  std::array<double, 3> slope{};
};

/// Rows of all intensities, then of the bearings. The device must not stand at a receiver.
/// `scattered` is of the same readings. Ray slopes are central differences over 2e-5 of the
/// distance: good to 1e-9 of themselves, except across a corner of a tabulated curve.
std::vector<MisfitRow> misfit_rows(const LightModel& model, const std::vector<Reading>& readings,
                                   const ScatteredLight& scattered, const Unknowns& unknowns);

/// Sum of their squares, without the slopes and so in a fifth of the time.
double chi_square(const LightModel& model, const std::vector<Reading>& readings,
                  const ScatteredLight& scattered, const Unknowns& unknowns);

/// Predicted less measured direction to a device, from -pi to pi.
double bearing_error(const Reading& reading, const Position& device);

/// Distance to the nearest receiver; infinite if there is none.
double nearest_receiver(const std::vector<Reading>& readings, const Position& device);

}  // namespace sim
