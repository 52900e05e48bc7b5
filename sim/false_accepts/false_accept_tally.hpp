#pragma once
// What a receiver accepted of the line: in integers, so that the order of adding changes nothing.
#include <cstdint>

namespace sim {

struct FalseAcceptTally {
  std::uint64_t n_runs = 0;
  std::uint64_t n_frames = 0;             // messages that the device sent
  std::uint64_t n_frames_ok = 0;          // accepted as sent
  std::uint64_t n_frames_undetected = 0;  // accepted while it sent, but not what was sent
  std::uint64_t n_frames_false = 0;       // accepted while it sent nothing
  std::uint64_t n_rejected = 0;           // lines that ended and were refused
  std::uint64_t n_characters = 0;         // that the UART read, whatever they were
  // Each run's own number, squared.
  std::uint64_t undetected_squared = 0, false_squared = 0;

  FalseAcceptTally& operator+=(const FalseAcceptTally& other) {
    n_runs += other.n_runs;
    n_frames += other.n_frames;
    n_frames_ok += other.n_frames_ok;
    n_frames_undetected += other.n_frames_undetected;
    n_frames_false += other.n_frames_false;
    n_rejected += other.n_rejected;
    n_characters += other.n_characters;
    undetected_squared += other.undetected_squared;
    false_squared += other.false_squared;
    return *this;
  }
  bool operator==(const FalseAcceptTally&) const = default;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(n_runs, n_frames, n_frames_ok, n_frames_undetected, n_frames_false, n_rejected,
            n_characters, undetected_squared, false_squared);
  }
};

}  // namespace sim
