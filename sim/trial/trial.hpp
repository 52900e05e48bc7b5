#pragma once
// One trial: a device sends a message, a receiver module and a UART try to hear it. Read this and
// trial.cpp first; everything else in the program is a detail of one of its lines.
//
//   step          what                                            value                type
//   1 message     COSYS encode (once a point, sim/link)           bytes                Bytes
//   2 UART        8N1 on the device's own clock                   level over time      LogicTrace
//   3 keying      level 0 -> carrier on                           lit time             T
//   4 light       LED pattern, direct + floor (once a point)      irradiance           T
//   5 noise       shot (signal, ambient), thermal                 irradiance           T
//   6 module      limiter, band-pass, threshold, integrator       pin level            Mask<T>
//   7 edges       changes of the pin                              level over time      LogicTrace
//   8 UART        a decoder on its own clock                      bytes, framing flags UartByte
//   9 frames      COSYS decode                                    frame or a reason    CosysFrame
//  10 count       sent against heard                              counters             Tally
//
// Steps 3-7 are channel::propagate, per sample, for one trial or many; for a matched receiver they
// can be one draw a bit (sim/trial/decision_trial), for a module one step a carrier cycle
// (sim/trial/envelope_trial). For errors too rare to count, step 5 is drawn to make them, and step
// 10 weighs what comes of it (sim/trial/importance_trial). Inside step 6 (channel/receiver_module):
// the light passes the front end's bandwidth, is clipped at the limiter and rings up a band-pass at
// the module's own f0; a comparator fires once a carrier cycle while that exceeds max(fixed
// threshold, fraction of the tracked peak); an integrator counts up while it fires, down while it
// does not, and pulls the pin low when full, lets it go when empty, 8 cycles either way. Bursts
// longer than the part allows make a slow AGC raise the fixed threshold until they are no longer
// seen.
//
// A trial sends `warmup_messages` first, so that the module's AGC is where repetition takes it, and
// counts the last message only: one trial is one frame.
#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include "dsp/logic_trace.hpp"
#include "dsp/philox.hpp"
#include "protocol/cosys.hpp"
#include "sim/counting/tally.hpp"
#include "sim/link/link.hpp"
#include "sim/threads/profile.hpp"

namespace sim {

/// Causes of randomness; each has draws of its own, so a new one leaves the old as they were.
enum class Purpose : std::uint32_t {
  timing = 1,
  jitter = 2,
  carrier_phase = 3,
  noise = 4,
  uart_phase = 5,
  unit = 6,
  disturbance = 7,  // and the numbers that end in this byte: one for each
  // Of runs of trials by importance sampling.
  choice = 8,            // of the trial
  prescribed_noise = 9,  // where bits are decided, before it is changed
  proposal = 10,         // how it is changed
  noise_around = 11,     // elsewhere
  // Of arenas.
  sender = 12,       // and the numbers that end in this byte: a few for each
  serial_line = 13,  // and the numbers that end in this byte: two for each way
  // Of exchanges.
  shared_node = 14,  // and the numbers that end in this byte: eight for each
  // Of light that is measured, not decoded (sim/location).
  meter_window = 32,
  meter_noise = 33,
  reading_noise = 34
};

/// The draws of a purpose in one trial of a link.
dsp::RandomAddress address(const Link& link, std::uint32_t trial, Purpose purpose);

/// A message on the wire: when each of its characters starts, and when the last one ends.
struct SentMessage {
  std::vector<dsp::Seconds> byte_start;
  dsp::Seconds end;
};

struct Transmission {
  dsp::LogicTrace line;               // what keys the LED
  std::vector<SentMessage> messages;  // in order; the last is the one that counts
};

/// Everything that one trial's receiver heard.
struct Reception {
  dsp::LogicTrace pin;
  std::optional<dsp::LogicTrace> of_pulses;  // whole bits, where a monostable makes them of it
  std::vector<protocol::UartByte> bytes;
  std::vector<protocol::CosysFrame> frames;
  std::vector<dsp::Seconds> frame_end;  // start of the byte that completed each frame

  /// What the decoder reads.
  const dsp::LogicTrace& line() const { return of_pulses ? *of_pulses : pin; }
};

/// Dark before a trial's first message.
inline constexpr dsp::Seconds lead_in(20e-3);

/// Appends the link's message to a line. Each character takes a draw of `jitter`, from `draws` on.
SentMessage send_message(const Link& link, dsp::LogicTrace& line, dsp::Seconds start,
                         const dsp::RandomAddress& jitter, std::uint32_t& draws);

/// Steps 1-2: the trial's messages, at its own random instants.
Transmission transmit(const Link& link, std::uint32_t trial);

/// How long that is on average, dark before and behind included.
dsp::Seconds mean_length(const Link& link);

/// How long that is at most.
dsp::Seconds longest_length(const Link& link);

/// Seed of all noise of a trial.
std::array<std::uint32_t, 4> noise_seed(const Link& link, std::uint32_t trial);

/// The module of a trial: its own unit, where each trial has one.
channel::ModuleData drawn_module(const Link& link, std::uint32_t trial);

/// The trial's own unit of the module, where each trial has one.
std::optional<channel::ModuleDesign> draw_unit(const Link& link, std::uint32_t trial);

/// Phase of the carrier at time 0 of a trial, in 2^-32 cycles.
std::uint32_t carrier_phase(const Link& link, std::uint32_t trial);

/// The random state of steps 3-7 for one trial; points to its transmission and unit.
channel::ChainInput chain_input(const Link& link, std::uint32_t trial, const Transmission& sent,
                                const std::optional<channel::ModuleDesign>& unit = std::nullopt);

/// When each bit is sent: what a matched receiver, which then makes steps 6-7, is told.
channel::BitSlots bit_slots(const Link& link, const Transmission& sent);

/// Steps 8-9: what the decoder makes of the pin.
Reception receive(const Link& link, std::uint32_t trial, dsp::LogicTrace pin);

/// Whether a frame, whose last byte began at `end`, was heard while any message was on the way.
bool overlaps_any(const Link& link, const Transmission& sent, const protocol::CosysFrame& frame,
                  dsp::Seconds end);

/// Step 10: the last message sent against what was heard.
Tally count(const Link& link, const Transmission& sent, const Reception& heard);

/// What a group of trials cost and gave.
struct GroupResult {
  Tally tally;
  double simulated_s = 0;
  std::uint64_t n_samples = 0;
  Profile profile{};

  GroupResult& operator+=(const GroupResult& other) {
    tally += other.tally;
    simulated_s += other.simulated_s;
    n_samples += other.n_samples;
    profile += other.profile;
    return *this;
  }
};

/// All steps for trials first ... first + n - 1 (n up to channel::lanes_per_group) at once. Worth
/// nothing once `*stop` is true: it then gives up soon. `profiled`: with a profile of its time.
GroupResult run_group(const Link& link, std::uint32_t first, int n,
                      const std::atomic<bool>* stop = nullptr, bool profiled = false);

/// The same for groups in a row: of trials first ... first + n - 1, eight a group but for the last.
/// A profile is the first group's, of all. Where the processor has lanes for several groups they
/// take about the time of one.
std::vector<GroupResult> run_groups(const Link& link, std::uint32_t first, int n,
                                    const std::atomic<bool>* stop = nullptr, bool profiled = false);

}  // namespace sim
