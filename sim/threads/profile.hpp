#pragma once
// Where the time of a run goes, stage by stage: `cosys-sim run --profile`.
#include <cstdint>
#include <string>

#include "channel/stage_clock.hpp"

namespace sim {

/// Wall-clock seconds of the threads that run trials; 0 where nobody asked. Steps as of sim/trial.
struct Profile {
  double messages_s = 0;                   // steps 1-2, and drawing what steps 3-7 need
  channel::StageClock::Seconds chain_s{};  // steps 3-7
  double envelope_s = 0;                   // the same by their envelope
  double decisions_s = 0;                  // the same where each bit is one decision variable
  double decoding_s = 0;                   // steps 8-10

  Profile& operator+=(const Profile& other);
};

/// A line for each stage: seconds of all threads together, share, and time for a sample of a trial
/// where samples were made.
std::string profile_lines(const Profile& profile, std::uint64_t n_samples);

/// Where the time of a whole run went, of any experiment.
struct RunProfile {
  double preparing_s = 0;   // of the points
  double running_s = 0;     // of all threads
  double describing_s = 0;  // of the points, by what their runs counted
  double writing_s = 0;     // of the result
  std::uint64_t n_runs = 0;
};

/// With time for a run.
std::string profile_lines(const RunProfile& profile);

}  // namespace sim
