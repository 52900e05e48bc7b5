#include "sim/arena/arena_run.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "protocol/cosys.hpp"
#include "protocol/short_pulses.hpp"
#include "sim/arena/airtime.hpp"
#include "sim/link/disturbance.hpp"
#include "sim/trial/trial.hpp"

namespace sim {
namespace {

using dsp::Seconds;

dsp::RandomAddress address(const Arena& arena, std::uint32_t run, Purpose purpose) {
  return {.seed = arena.seed,
          .point = arena.point,
          .trial = run,
          .purpose = static_cast<std::uint32_t>(purpose)};
}

/// Draws of one sender; it takes three purposes, its carrier the fourth.
dsp::RandomAddress sender_address(const Arena& arena, std::uint32_t run, const Sender& sender) {
  dsp::RandomAddress draws = address(arena, run, Purpose::sender);
  draws.point = sender.point;
  return draws;
}

std::uint32_t carrier_phase(dsp::RandomAddress draws) {
  draws.purpose += 3U << 8U;
  return draws.block(0)[0];
}

/// Runs before they are heard.
struct DrawnRuns {
  dsp::LogicTrace dark;                         // the chain's own wire, of which there is no light
  std::vector<std::vector<SentFrames>> sent{};  // of each run, of each sender; drives are moved on
  std::vector<channel::ChainInput> inputs{};    // of each run; point to `dark`
};

void draw_other_lights(const Arena& arena, std::uint32_t run, channel::ChainInput& input) {
  dsp::RandomAddress draws = address(arena, run, Purpose::disturbance);
  for (const DisturbanceSettings& disturbance : arena.disturbances) {
    input.disturbances.push_back(draw_disturbance(disturbance, draws, arena.end));
    draws.purpose += 1U << 8U;
  }
}

void draw(const Arena& arena, std::uint32_t run, DrawnRuns& drawn) {
  std::vector<SentFrames>& sent = drawn.sent.emplace_back();
  channel::ChainInput& input = drawn.inputs.emplace_back(
      channel::ChainInput{.drive = &drawn.dark,
                          .carrier_phase = 0,
                          .noise_seed = address(arena, run, Purpose::noise).block(0)});
  draw_other_lights(arena, run, input);
  for (const Sender& sender : arena.senders) {
    const dsp::RandomAddress draws = sender_address(arena, run, sender);
    sent.push_back(send(sender, draws, arena.end));
    const dsp::LogicTrace grown = std::exchange(sent.back().drive, dsp::LogicTrace());
    input.disturbances.push_back({.phase = {carrier_phase(draws), 0}, .drive = grown});  // fits
  }
}

/// What the decoder makes of a pin.
struct HeardLine {
  std::vector<protocol::UartByte> bytes;
  std::vector<protocol::CosysFrame> frames;  // good ones
};

HeardLine listen(const Arena& arena, std::uint32_t run, const dsp::LogicTrace& pin) {
  const double phase = address(arena, run, Purpose::uart_phase).uniform(0);
  const protocol::UartReceiver& uart = *arena.uart;
  const dsp::Hertz baud = arena.receiver_baud;
  HeardLine heard{arena.has_monostable ? uart.receive(protocol::whole_bits(pin, baud), baud, phase)
                                       : uart.receive(pin, baud, phase),
                  {}};
  protocol::CosysDecoder decoder;
  for (const protocol::UartByte& byte : heard.bytes)
    if (auto frame = decoder.push(byte); frame && frame->outcome == protocol::CosysOutcome::ok)
      heard.frames.push_back(std::move(*frame));
  return heard;
}

Seconds half_bit(const Sender& sender) { return dsp::period(sender.baud) * 0.5; }

/// The first of `events` (by their `start`) that was heard when `sent` should be.
template <class Event>
const Event* heard_at(const std::vector<Event>& events, Seconds sent, Seconds delay, Seconds half,
                      auto fits) {
  auto at = std::ranges::lower_bound(events, sent + delay - half, {}, &Event::start);
  for (; at != events.end() && at->start < sent + delay + half; ++at)
    if (fits(*at)) return &*at;
  return nullptr;
}

const protocol::CosysFrame* delivery_of(const SentFrame& frame, const Sender& sender,
                                        const HeardLine& heard, Seconds delay) {
  return heard_at(heard.frames, frame.start, delay, half_bit(sender),
                  [&](const protocol::CosysFrame& f) { return f.message == frame.message; });
}

/// Whether each of its characters was heard as one, be it another.
bool whole(const SentFrame& frame, const Sender& sender, const HeardLine& heard, Seconds delay) {
  const Seconds character = frame_time(sender, 1);
  const auto n = static_cast<std::size_t>(std::lround((frame.end - frame.start) / character));
  for (std::size_t i = 0; i < n; ++i)
    if (heard_at(heard.bytes, frame.start + static_cast<double>(i) * character, delay,
                 half_bit(sender),
                 [](const protocol::UartByte& b) { return !b.framing_error; }) == nullptr)
      return false;
  return true;
}

/// All that is known of one run.
struct RunObservation {
  const Arena& arena;
  const Airtime& air;
  const HeardLine& heard;
  const HeardLine& without_slow_agc;
};

LossCause loss_cause_of(const RunObservation& w, std::size_t sender, const SentFrame& frame) {
  const Sender& from = w.arena.senders[sender];
  const Seconds delay = w.arena.delay;
  if (frame.silent) return LossCause::silent;
  if (delivery_of(frame, from, w.heard, delay) != nullptr) return LossCause::delivered;
  if (!w.air.in_reach(sender, frame)) return LossCause::out_of_reach;
  if (delivery_of(frame, from, w.without_slow_agc, delay) != nullptr) return LossCause::agc;
  if (w.air.overlapped(sender, frame)) return LossCause::collision;
  return whole(frame, from, w.heard, delay) ? LossCause::checksum : LossCause::uart;
}

std::uint64_t microseconds(Seconds t) {
  return static_cast<std::uint64_t>(std::llround(t.value * 1e6));
}

void count_airtime(const RunObservation& w, std::size_t sender, const SentFrame& frame,
                   LossCause cause, SenderTally& tally) {
  const bool delivered = cause == LossCause::delivered;
  const std::uint64_t airtime = microseconds(frame.end - frame.start);
  tally.airtime_us += airtime;
  if (delivered) tally.airtime_delivered_us += airtime;
  if (cause == LossCause::out_of_reach) return;
  tally.airtime_in_reach_us += airtime;
  ++tally.n_in_reach;
  const bool overlapped = w.air.overlapped(sender, frame);
  tally.n_overlapped += overlapped;
  tally.n_captured += overlapped && delivered;
}

/// Frames that start within the run.
SenderTally count_sender(const RunObservation& w, std::size_t sender,
                         const std::vector<SentFrame>& frames, std::uint32_t run, ArenaRuns& into) {
  SenderTally tally;
  for (const SentFrame& frame : frames) {
    if (frame.start < Seconds(0) || frame.start >= w.arena.duration) continue;
    const LossCause cause = loss_cause_of(w, sender, frame);
    ++tally.by_cause[static_cast<std::size_t>(cause)];
    if (cause == LossCause::silent) continue;
    count_airtime(w, sender, frame, cause, tally);
    if (cause != LossCause::delivered) continue;
    if (tally.latency.n_runs_heard == 0) tally.latency.add(frame.end);
    const Pose2D place = w.arena.way.at(frame.end);
    into.heard.push_back({run, static_cast<std::uint32_t>(sender), frame.start.value,
                          frame.end.value, place.x, place.y, frame.message});
  }
  tally.losses.add(tally.lost(), tally.sent());
  return tally;
}

/// Whether somebody sent what was accepted.
bool is_true(const Arena& arena, const std::vector<SentFrames>& sent,
             const protocol::CosysFrame& heard) {
  const HeardLine one{{}, {heard}};
  for (std::size_t i = 0; i < sent.size(); ++i)
    for (const SentFrame& frame : sent[i].frames)
      if (!frame.silent && delivery_of(frame, arena.senders[i], one, arena.delay) != nullptr)
        return true;
  return false;
}

void count_run(const Arena& arena, std::uint32_t run, const std::vector<SentFrames>& sent,
               const HeardLine& heard, const HeardLine& without_slow_agc, ArenaRuns& into) {
  const Airtime air(arena, sent);
  const RunObservation observation{arena, air, heard, without_slow_agc};
  const auto before = static_cast<std::ptrdiff_t>(into.heard.size());
  std::uint64_t lost = 0, all = 0;
  for (std::size_t i = 0; i < arena.senders.size(); ++i) {
    const SenderTally tally = count_sender(observation, i, sent[i].frames, run, into);
    into.tally.senders[i] += tally;
    lost += tally.lost();
    all += tally.sent();
  }
  into.tally.losses.add(lost, all);
  const auto first = std::ranges::min_element(into.heard.begin() + before, into.heard.end(), {},
                                              &HeardFrame::end_s);
  if (first != into.heard.end()) into.tally.any.add(Seconds(first->end_s));
  for (const protocol::CosysFrame& frame : heard.frames)
    into.tally.n_false += !is_true(arena, sent, frame);
  ++into.tally.n_runs;
}

/// Pins of the runs if the module had no slow AGC.
std::vector<dsp::LogicTrace> pins_without_slow_agc(const Arena& arena, DrawnRuns& runs,
                                                   const std::atomic<bool>* stop) {
  for (channel::ChainInput& input : runs.inputs) input.unit = &arena.without_slow_agc;
  return channel::propagate(arena.chain, runs.inputs, stop);
}

}  // namespace

ArenaRuns& ArenaRuns::operator+=(const ArenaRuns& next) {
  tally += next.tally;
  heard.insert(heard.end(), next.heard.begin(), next.heard.end());
  return *this;
}

ArenaRuns run_arena(const Arena& arena, std::uint32_t first, int n, const std::atomic<bool>* stop) {
  DrawnRuns runs{.dark = dsp::LogicTrace(true, arena.end)};
  for (int i = 0; i < n; ++i) draw(arena, first + static_cast<std::uint32_t>(i), runs);
  const auto pins = channel::propagate(arena.chain, runs.inputs, stop);
  const auto without = arena.has_slow_agc ? pins_without_slow_agc(arena, runs, stop) : pins;
  ArenaRuns result;
  result.tally.senders.resize(arena.senders.size());
  for (std::size_t i = 0; i < pins.size(); ++i) {
    const auto run = first + static_cast<std::uint32_t>(i);
    count_run(arena, run, runs.sent[i], listen(arena, run, pins[i]), listen(arena, run, without[i]),
              result);
  }
  std::ranges::sort(result.heard, {},
                    [](const HeardFrame& h) { return std::tuple(h.run, h.end_s, h.sender); });
  return result;
}

}  // namespace sim
