#pragma once
// A baseline: what a decoder made of each frame of some scenarios, to judge others by. Each frame's
// light is in it as a hash, so that a check knows whether it sees the same.
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/check/frame_outcome.hpp"
#include "sim/check/judged_point.hpp"
#include "sim/program_info.hpp"

namespace sim {

struct FrameRecord {
  FrameOutcome outcome;
  std::uint64_t light = 0;
};

struct BaselinePoint {
  std::string name;
  std::size_t scenario = 0;         // whose point it is
  std::uint64_t physics = 0;        // a hash of what decides its light
  std::vector<FrameRecord> frames;  // of trials 0, 1, ...
};

struct Baseline {
  ProgramInfo program;
  std::string command;  // that made it
  std::string decoder;
  std::vector<std::string> scenarios;  // whole texts, enough to repeat them
  std::vector<BaselinePoint> points;
};

/// In the netCDF-4 model, replacing nothing but a baseline.
void write_baseline(const std::filesystem::path& path, const Baseline& baseline);
/// Throws Failure(bad_input) for a file that is none, or damaged.
Baseline read_baseline(const std::filesystem::path& path);
/// Throws Failure where a baseline cannot be written to that place.
void check_baseline_place(const std::filesystem::path& path);

/// The baseline's point of that name. Throws Failure(bad_input), naming what differs, where it has
/// none, or of another scenario.
const BaselinePoint& counterpart(const Baseline& baseline, const JudgedPoint& point,
                                 const std::filesystem::path& file);

/// What is in BaselinePoint::physics.
std::uint64_t physics_hash(const JudgedPoint& point);

}  // namespace sim
