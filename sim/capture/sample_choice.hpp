#pragma once
// Which channel of a capture of samples is read, and what is on one.
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sim/capture/capture_file.hpp"
#include "sim/capture/sample_capture.hpp"
#include "sim/capture/wire_choice.hpp"

namespace sim {

/// Looks at the first four million samples at most.
ChannelSurvey survey_of_samples(std::string name, SampleCapture& samples, const LineHints& hints);

/// All channels of a capture, at least one.
struct SampleChannels {
  std::vector<std::string> names;
  std::function<std::unique_ptr<SampleCapture>(std::size_t channel)> open;  // from its start on
  bool opens_again = true;                                                  // not so a pipe
};

/// Fills in `capture.samples` and the facts: the channel that was asked for, else by what is on
/// them, or the first where that cannot be looked at. Throws Failure(bad_input).
void take_samples(const std::string& file, const SampleChannels& channels,
                  const CaptureSettings& settings, Capture& capture);

}  // namespace sim
