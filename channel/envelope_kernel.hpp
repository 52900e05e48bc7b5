#pragma once
// The border between the envelope (channel/envelope.hpp) and its kernels, which obeys the rules of
// channel/chain_kernel.hpp: only plain data crosses.
#include <array>
#include <cstddef>
#include <cstdint>

#include "channel/instruction_set.hpp"

namespace channel {

/// Steps that are computed at a time.
constexpr std::int32_t envelope_block = 64;

template <class T>
struct EnvelopeDesignOf;

/// Light begins or ends: what that adds to the response to edges as it was a step before the next,
/// and the light from there on. mW/m2.
struct EnvelopeEdge {
  std::int32_t step;  // from the stretch's begin
  float re, im;
  bool lit;
};

/// A stretch of a trial, behind `rest` steps of which nothing but the gain is computed.
struct EnvelopeStretch {
  const EnvelopeEdge* edges = nullptr;
  std::size_t n_edges = 0;
  float rest = 0;
};

struct EnvelopeKernelInput {
  struct Lane {
    const EnvelopeStretch* stretches = nullptr;
    std::array<std::uint32_t, 4> noise_seed{};
  };
  Lane lane[most_lanes];
  const EnvelopeDesignOf<float>* design = nullptr;
  const std::int32_t* steps = nullptr;  // of each stretch, in all lanes; whole blocks
  std::size_t n_stretches = 0;
  /// Called when a lane's pin changes: at how many steps from the stretch's begin.
  void (*on_edge)(void* context, int lane, std::size_t stretch, double step) = nullptr;
  /// Whether to give up, asked in each block.
  bool (*stopped)(void* context) = nullptr;
  void* context = nullptr;
};

void run_envelopes_baseline(const EnvelopeKernelInput& input);
void run_envelopes_v3(const EnvelopeKernelInput& input);  // x86-64-v3: AVX2 and FMA
void run_envelopes_v4(const EnvelopeKernelInput& input);  // x86-64-v4: AVX-512, all lanes

}  // namespace channel
