#include "sim/check/frame_outcomes.hpp"

#include "sim/trial/heard_trials.hpp"

namespace sim {
namespace {

FrameOutcome outcome_of(const Tally& frame) {
  if (frame.n_frames_ok > 0) return FrameOutcome::delivered;
  return frame.n_frames_undetected > 0 ? FrameOutcome::deceived : FrameOutcome::lost;
}

}  // namespace

std::vector<std::vector<FrameOutcome>> frame_outcomes(
    const Link& link, const std::vector<const protocol::UartReceiver*>& receivers,
    std::uint32_t first, int n, const std::atomic<bool>* stop) {
  const HeardTrials heard = hear_trials(link, first, n, stop);
  std::vector<std::vector<FrameOutcome>> outcomes(receivers.size());
  for (std::size_t r = 0; r < receivers.size(); ++r)
    for (std::size_t i = 0; i < heard.sent.size(); ++i) {
      const auto trial = first + static_cast<std::uint32_t>(i);
      const Reception reception = receive(link, trial, heard.pins[i], *receivers[r]);
      outcomes[r].push_back(outcome_of(count(link, heard.sent[i], reception)));
    }
  return outcomes;
}

}  // namespace sim
