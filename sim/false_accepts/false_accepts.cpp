#include "sim/false_accepts/false_accepts.hpp"

#include <utility>

#include "sim/false_accepts/false_accept_keys.hpp"
#include "sim/scenario/disturbance_keys.hpp"
#include "sim/trial/drawn_trials.hpp"

namespace sim {
namespace {

using dsp::Seconds;

/// No name that a user can give to a disturbance.
const std::string air_name = "listening.air";

Seconds pause(const Link& link, double u) {
  return link.interval_min + u * (link.interval_max - link.interval_min);
}

Seconds longest_message(const Link& link) {
  const Seconds character =
      protocol::bits_per_byte * dsp::period(link.device_baud) + link.start_jitter;
  return static_cast<double>(link.bytes.size()) * character;
}

/// Messages that the run has room for, each with its pause before it.
void send_messages(const FalseAcceptSetup& setup, std::uint32_t run, Transmission& sent) {
  const Link& link = setup.link;
  const dsp::RandomAddress timing = address(link, run, Purpose::timing);
  const dsp::RandomAddress jitter = address(link, run, Purpose::jitter);
  std::uint32_t pauses = 0, characters = 0;
  Seconds start = timing.uniform(pauses++) * pause(link, 1);
  while (start + longest_message(link) < setup.duration) {
    sent.messages.push_back(send_message(link, sent.line, start, jitter, characters));
    start = sent.messages.back().end + pause(link, timing.uniform(pauses++));
  }
}

void count_line(const Link& link, const Transmission& sent, const protocol::CosysFrame& frame,
                dsp::Seconds end, FalseAcceptTally& tally) {
  if (frame.outcome != protocol::CosysOutcome::ok)
    ++tally.n_rejected;
  else if (!overlaps_any(link, sent, frame, end))
    ++tally.n_frames_false;
  else
    ++(frame.message == link.message ? tally.n_frames_ok : tally.n_frames_undetected);
}

FalseAcceptTally tally_of(const Link& link, const Transmission& sent, const Reception& heard) {
  FalseAcceptTally tally{.n_runs = 1, .n_frames = sent.messages.size()};
  tally.n_characters = heard.bytes.size();
  for (std::size_t i = 0; i < heard.frames.size(); ++i)
    count_line(link, sent, heard.frames[i], heard.frame_end[i], tally);
  tally.undetected_squared = tally.n_frames_undetected * tally.n_frames_undetected;
  tally.false_squared = tally.n_frames_false * tally.n_frames_false;
  return tally;
}

}  // namespace

Scenario with_air(const Scenario& scenario) {
  Scenario s = scenario;
  if (s.settings.of<FalseAcceptSettings>().air == FalseAcceptSettings{}.air) return s;
  DisturbanceSettings& air = s.disturbances[air_name];
  air.kind = s.settings.of<FalseAcceptSettings>().air;
  take_defaults(air);
  return s;
}

FalseAcceptSetup make_false_accepts(const Scenario& scenario) {
  return {.link = make_link(with_air(scenario)),
          .device_sends = scenario.settings.of<FalseAcceptSettings>().device_sends != 0,
          .duration = Seconds(scenario.settings.of<FalseAcceptSettings>().duration_s)};
}

Transmission line_of(const FalseAcceptSetup& setup, std::uint32_t run) {
  Transmission sent;
  if (setup.device_sends) send_messages(setup, run, sent);
  sent.line.observe_until(setup.duration);
  return sent;
}

HeardTrials hear_runs(const FalseAcceptSetup& setup, std::uint32_t first, int n,
                      const std::atomic<bool>* stop) {
  const Link& link = setup.link;
  std::vector<Transmission> sent;
  for (int i = 0; i < n; ++i) sent.push_back(line_of(setup, first + static_cast<std::uint32_t>(i)));
  DrawnTrials drawn = draw_trials(link, first, std::move(sent));
  std::vector<dsp::LogicTrace> pins = channel::propagate(link.chain, drawn.inputs, stop);
  return {.sent = std::move(drawn.sent), .pins = std::move(pins), .profile = {}};
}

FalseAcceptTally run_false_accepts(const FalseAcceptSetup& setup, std::uint32_t first, int n,
                                   const std::atomic<bool>* stop) {
  HeardTrials heard = hear_runs(setup, first, n, stop);
  const Link& link = setup.link;
  FalseAcceptTally sum;
  for (std::size_t i = 0; i < heard.sent.size(); ++i)
    sum += tally_of(link, heard.sent[i],
                    receive(link, first + static_cast<std::uint32_t>(i), std::move(heard.pins[i])));
  return sum;
}

double hours_of(const FalseAcceptSetup& setup, std::uint64_t runs) {
  constexpr double seconds_in_an_hour = 3600;
  return static_cast<double>(runs) * setup.duration.value / seconds_in_an_hour;
}

}  // namespace sim
