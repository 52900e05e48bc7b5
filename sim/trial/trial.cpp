#include "sim/trial/trial.hpp"

#include <algorithm>
#include <utility>

#include "channel/conditions.hpp"
#include "dsp/philox.hpp"
#include "protocol/short_pulses.hpp"
#include "sim/components/drawn_part.hpp"
#include "sim/link/disturbance.hpp"
#include "sim/threads/stopwatch.hpp"
#include "sim/trial/decision_trial.hpp"
#include "sim/trial/drawn_trials.hpp"
#include "sim/trial/heard_trials.hpp"
#include "sim/trial/importance_trial.hpp"

namespace sim {
namespace {

constexpr dsp::Seconds lead_out(20e-3);  // dark behind the last: module and UART have finished

std::vector<channel::DisturbanceInput> draw_disturbances(const Link& link, std::uint32_t trial,
                                                         dsp::Seconds end) {
  std::vector<channel::DisturbanceInput> inputs;
  dsp::RandomAddress draws = address(link, trial, Purpose::disturbance);
  for (const DisturbanceSettings& disturbance : link.disturbances) {
    inputs.push_back(draw_disturbance(disturbance, draws, end));
    draws.purpose += 1U << 8U;
  }
  return inputs;
}

dsp::Seconds half_bit(const Link& link) { return dsp::period(link.device_baud) * 0.5; }

/// When something heard at `at` must have left the device, less than half a bit wrong.
bool within(const SentMessage& message, dsp::Seconds at, const Link& link) {
  const dsp::Seconds sent = at - link.delay;
  return sent >= message.byte_start.front() - half_bit(link) && sent < message.end;
}

void count_bits(const Link& link, const SentMessage& message, const dsp::LogicTrace& line,
                Tally& tally) {
  dsp::TraceReader reader(line);
  for (std::size_t i = 0; i < link.bytes.size(); ++i) {
    for (int slot = 0; slot < protocol::bits_per_byte; ++slot) {
      const dsp::Seconds centre =
          message.byte_start[i] + dsp::period(link.device_baud) * (slot + 0.5);
      ++tally.n_bits;
      const bool heard = reader.level_at(centre + link.delay);
      tally.n_bit_errors += heard != protocol::line_bit(link.bytes[i], slot);
    }
  }
  tally.n_frames_bit_errors = tally.n_bit_errors > 0;
  tally.sum_bit_errors_squared = tally.n_bit_errors * tally.n_bit_errors;
  tally.sum_bits_squared = tally.n_bits * tally.n_bits;
  tally.sum_bit_errors_times_bits = tally.n_bit_errors * tally.n_bits;
}

/// Bytes are compared by the time they start, never by index: one lost start bit would otherwise
/// make all that follow wrong.
bool heard_byte(const Link& link, dsp::Seconds start, std::uint8_t value, const Reception& heard) {
  const dsp::Seconds from = start + link.delay - half_bit(link);
  const dsp::Seconds to = start + link.delay + half_bit(link);
  auto byte = std::lower_bound(heard.bytes.begin(), heard.bytes.end(), from,
                               [](const auto& b, dsp::Seconds t) { return b.start < t; });
  for (; byte != heard.bytes.end() && byte->start < to; ++byte)
    if (byte->value == value && !byte->framing_error) return true;
  return false;
}

void count_bytes(const Link& link, const SentMessage& message, const Reception& heard,
                 Tally& tally) {
  tally.n_bytes = link.bytes.size();
  for (std::size_t i = 0; i < link.bytes.size(); ++i)
    tally.n_byte_errors += !heard_byte(link, message.byte_start[i], link.bytes[i], heard);
  for (const protocol::UartByte& byte : heard.bytes)
    tally.n_framing_errors += byte.framing_error && within(message, byte.start, link);
}

void count_rejected(protocol::CosysOutcome outcome, Tally& tally) {
  using enum protocol::CosysOutcome;
  switch (outcome) {
    case ok:
      return;
    case unprintable:
      ++tally.n_rejected_unprintable;
      return;
    case too_short:
      ++tally.n_rejected_short;
      return;
    case not_hex:
      ++tally.n_rejected_not_hex;
      return;
    case wrong_checksum:
      ++tally.n_rejected_checksum;
      return;
    case overlong:
      ++tally.n_rejected_overlong;
      return;
  }
}

bool heard_any(const SentMessage& message, const Reception& heard, const Link& link) {
  return std::any_of(heard.bytes.begin(), heard.bytes.end(), [&](const protocol::UartByte& byte) {
    return within(message, byte.start, link);
  });
}

void count_frames(const Link& link, const Transmission& sent, const Reception& heard,
                  Tally& tally) {
  tally.n_frames = 1;
  const SentMessage& counted = sent.messages.back();
  bool delivered = false, undetected_error = false, ended = false;
  for (std::size_t i = 0; i < heard.frames.size(); ++i) {
    const protocol::CosysFrame& frame = heard.frames[i];
    if (!overlaps_any(link, sent, frame, heard.frame_end[i])) {
      tally.n_frames_false += frame.outcome == protocol::CosysOutcome::ok;
    } else if (within(counted, heard.frame_end[i], link)) {
      const bool accepted = frame.outcome == protocol::CosysOutcome::ok;
      delivered |= accepted && frame.message == link.message;
      undetected_error |= accepted && frame.message != link.message;
      ended = true;
      count_rejected(frame.outcome, tally);
    }
  }
  tally.n_frames_ok = delivered;
  tally.n_frames_lost = !delivered;
  tally.n_frames_undetected = undetected_error;
  if (!ended) ++(heard_any(counted, heard, link) ? tally.n_frames_unended : tally.n_frames_unheard);
}

GroupResult count_group(const Link& link, std::uint32_t first, const TrialSpan& group,
                        const std::vector<Transmission>& sent, std::vector<dsp::LogicTrace>& pins) {
  GroupResult result;
  for (std::size_t i = group.first; i < group.first + group.n; ++i) {
    const auto trial = first + static_cast<std::uint32_t>(i);
    result.tally += count(link, sent[i], receive(link, trial, std::move(pins[i])));
    add_cost(result, link, sent[i]);
  }
  return result;
}

/// A trial all of whose draws are `u`.
dsp::Seconds length_at(const Link& link, double u) {
  const double pauses = link.warmup_messages, messages = pauses + 1;
  const auto characters = static_cast<double>(link.bytes.size());
  const dsp::Seconds bit = dsp::period(link.device_baud);
  const dsp::Seconds character = bit * protocol::bits_per_byte + u * link.start_jitter;
  return lead_in + u * bit + messages * characters * character +
         pauses * ((1 - u) * link.interval_min + u * link.interval_max) + lead_out;
}

std::vector<GroupResult> decide_groups(const Link& link, std::uint32_t first, int n,
                                       bool profiled) {
  const auto groups = groups_of(static_cast<std::size_t>(n));
  std::vector<GroupResult> results;
  results.reserve(groups.size());
  for (const TrialSpan& group : groups)
    results.push_back(decide_group(link, first + static_cast<std::uint32_t>(group.first),
                                   static_cast<int>(group.n), profiled));
  return results;
}

}  // namespace

dsp::RandomAddress address(const Link& link, std::uint32_t trial, Purpose purpose) {
  return {.seed = link.seed,
          .point = link.point,
          .trial = trial,
          .purpose = static_cast<std::uint32_t>(purpose)};
}

SentMessage send_message(const Link& link, dsp::LogicTrace& line, dsp::Seconds start,
                         const dsp::RandomAddress& jitter, std::uint32_t& draws) {
  SentMessage message;
  for (const std::uint8_t byte : link.bytes) {
    start += jitter.uniform(draws++) * link.start_jitter;
    message.byte_start.push_back(start);
    start = protocol::send_byte_in_pulses(line, byte, start, link.device_baud, link.pulse);
  }
  message.end = start;
  return message;
}

Transmission transmit(const Link& link, std::uint32_t trial) {
  const dsp::RandomAddress timing = address(link, trial, Purpose::timing);
  const dsp::RandomAddress jitter = address(link, trial, Purpose::jitter);
  std::uint32_t draws = 0;
  Transmission sent;
  dsp::Seconds start = lead_in + timing.uniform(0) * dsp::period(link.device_baud);
  for (int i = 0; i <= link.warmup_messages; ++i) {
    sent.messages.push_back(send_message(link, sent.line, start, jitter, draws));
    const dsp::Seconds spread = link.interval_max - link.interval_min;
    const double u = timing.uniform(static_cast<std::uint32_t>(i) + 1);
    start = sent.messages.back().end + link.interval_min + u * spread;
  }
  sent.line.observe_until(sent.messages.back().end + lead_out);
  return sent;
}

dsp::Seconds mean_length(const Link& link) { return length_at(link, 0.5); }

dsp::Seconds longest_length(const Link& link) { return length_at(link, 1); }

std::array<std::uint32_t, 4> noise_seed(const Link& link, std::uint32_t trial) {
  return address(link, trial, Purpose::noise).block(0);
}

std::uint32_t carrier_phase(const Link& link, std::uint32_t trial) {
  return address(link, trial, Purpose::carrier_phase).block(0)[0];
}

channel::ModuleData drawn_module(const Link& link, std::uint32_t trial) {
  if (!link.population) return link.module;
  const dsp::RandomAddress draws = address(link, trial, Purpose::unit);
  return link.draws_constants ? drawn_unit(link.module, draws)
                              : channel::unit_of(link.module, draws.uniform(0), draws.uniform(1));
}

std::optional<channel::ModuleDesign> draw_unit(const Link& link, std::uint32_t trial) {
  if (!link.population) return std::nullopt;
  return channel::design_unit(drawn_module(link, trial), link.ambient, link.chain);
}

channel::ChainInput chain_input(const Link& link, std::uint32_t trial, const Transmission& sent,
                                const std::optional<channel::ModuleDesign>& unit) {
  return {.drive = &sent.line,
          .carrier_phase = carrier_phase(link, trial),
          .noise_seed = noise_seed(link, trial),
          .unit = unit ? &*unit : nullptr,
          .disturbances = draw_disturbances(link, trial, sent.line.end())};
}

channel::BitSlots bit_slots(const Link& link, const Transmission& sent) {
  const dsp::Seconds bit = dsp::period(link.device_baud);
  channel::BitSlots slots;
  for (const SentMessage& message : sent.messages)
    for (const dsp::Seconds start : message.byte_start)
      for (int slot = 0; slot < protocol::bits_per_byte; ++slot)
        slots.push_back({start + bit * slot, start + bit * (slot + 1)});
  return slots;
}

Reception receive(const Link& link, std::uint32_t trial, dsp::LogicTrace pin) {
  const double phase = address(link, trial, Purpose::uart_phase).uniform(0);
  Reception heard{
      .pin = std::move(pin), .of_pulses = {}, .bytes = {}, .frames = {}, .frame_end = {}};
  if (link.has_monostable) heard.of_pulses = protocol::whole_bits(heard.pin, link.receiver_baud);
  heard.bytes = link.uart->receive(heard.line(), link.receiver_baud, phase);
  protocol::CosysDecoder decoder;
  for (const protocol::UartByte& byte : heard.bytes) {
    if (auto frame = decoder.push(byte)) {
      heard.frames.push_back(std::move(*frame));
      heard.frame_end.push_back(byte.start);
    }
  }
  return heard;
}

bool overlaps_any(const Link& link, const Transmission& sent, const protocol::CosysFrame& frame,
                  dsp::Seconds end) {
  return std::any_of(sent.messages.begin(), sent.messages.end(), [&](const SentMessage& m) {
    return within(m, frame.start, link) || within(m, end, link);
  });
}

Tally count(const Link& link, const Transmission& sent, const Reception& heard) {
  Tally tally;
  count_bits(link, sent.messages.back(), heard.line(), tally);
  count_bytes(link, sent.messages.back(), heard, tally);
  count_frames(link, sent, heard, tally);
  return tally;
}

GroupResult run_group(const Link& link, std::uint32_t first, int n, const std::atomic<bool>* stop,
                      bool profiled) {
  return run_groups(link, first, n, stop, profiled).front();
}

std::vector<GroupResult> run_groups(const Link& link, std::uint32_t first, int n,
                                    const std::atomic<bool>* stop, bool profiled) {
  if (link.decisions) return decide_groups(link, first, n, profiled);
  if (link.importance) return run_weighted_groups(link, first, n, stop, profiled);
  HeardTrials heard = hear_trials(link, first, n, stop, profiled);
  const Stopwatch watch;
  std::vector<GroupResult> results;
  for (const TrialSpan& group : groups_of(heard.sent.size()))
    results.push_back(count_group(link, first, group, heard.sent, heard.pins));
  if (!profiled) return results;
  results.front().profile = heard.profile;
  results.front().profile.decoding_s = watch.seconds();
  return results;
}

}  // namespace sim
