#pragma once
// A plan out of a capture: what was on the wire that drives the LED, be it the carrier's pulses or
// a level for as long as light is on. Its times are the capture's, and its levels are all 0, as no
// wire tells them.
#include <filesystem>
#include <vector>

#include "sim/capture/capture_file.hpp"
#include "sim/fit/captured_lines.hpp"
#include "sim/fit/plan_text.hpp"

namespace sim {

/// A burst of light: cycles of a carrier from its first to its last.
struct DriveBurst {
  double start_s = 0;
  double carrier_hz = 0;
  std::uint64_t cycles = 0;
};

/// Bursts as steps; those that are alike and come evenly are one step.
Plan plan_of_bursts(const std::vector<DriveBurst>& bursts);

/// The plan of the wire that the settings name. `carrier_hz` is that of the light where the wire
/// has none. Throws Failure(bad_input) where nothing is on the wire.
Plan plan_of_drive(const std::filesystem::path& path, const CaptureSettings& settings,
                   double carrier_hz, const ReadingListener& reached);

}  // namespace sim
