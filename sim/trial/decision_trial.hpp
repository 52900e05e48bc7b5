#pragma once
// Trials of a link whose bits are decided without a waveform: steps 3-7 of sim/trial/trial.hpp are
// one draw a bit. All messages of a trial are drawn, those before the counted one too, as a decoder
// that missed the end of one still waits for it in the next. A trial with wrong bits has its pin
// written and goes through steps 8-10 as any other; one without counts what such trials count.
//
// No samples are made, so `n_samples` is 0; `simulated_s` is the mean length of a trial's messages
// and pauses, as the times of a trial without wrong bits are never drawn.
#include <cstdint>

#include "dsp/logic_trace.hpp"
#include "sim/trial/trial.hpp"

namespace sim {

/// run_group for such a link.
GroupResult decide_group(const Link& link, std::uint32_t first, int n, bool profiled);

/// The pin of one trial, computed alone; the one that decide_group counts.
dsp::LogicTrace decided_pin(const Link& link, std::uint32_t trial, const Transmission& sent);

}  // namespace sim
