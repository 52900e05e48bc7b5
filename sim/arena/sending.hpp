#pragma once
// What a sender of an arena sends in a run, and how much that is on average.
#include <string>
#include <vector>

#include "dsp/logic_trace.hpp"
#include "dsp/philox.hpp"
#include "sim/arena/sender.hpp"

namespace sim {

/// A message of a device, sent or left out in a silent spell.
struct SentFrame {
  dsp::Seconds start, end;
  std::string message;
  bool silent = false;
};

/// One sender in one run.
struct SentFrames {
  dsp::LogicTrace drive;  // low = light
  std::vector<SentFrame> frames;
};

/// It began long before time 0, at a random time, and sends until `end`: frames that end after time
/// 0 and start before `end`. Purposes from `draws` on, a few, are its own.
SentFrames send(const Sender& sender, const dsp::RandomAddress& draws, dsp::Seconds end);

/// The time that a message of so many bytes takes.
dsp::Seconds frame_time(const Sender& sender, std::size_t bytes);

/// The time that the longest of its messages takes.
dsp::Seconds longest_frame(const Sender& sender);

/// Share of time in which it sends, on average.
double mean_load(const Sender& sender);

/// Share of time in which its LED is lit, on average: its carrier's duty included.
double mean_light(const Sender& sender);

}  // namespace sim
