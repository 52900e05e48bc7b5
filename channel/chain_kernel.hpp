#pragma once
// The border between the chain and its kernels. A kernel is one translation unit built for one
// instruction set; only plain data and function pointers cross, so that no inline code of one set
// is ever linked into another (a test looks at the symbols).
#include <array>
#include <cstddef>
#include <cstdint>

#include "channel/instruction_set.hpp"

namespace channel {

struct Burst;
struct CarrierDesign;
struct MarginWindow;
struct NoiseWindow;
struct SlotSamples;
struct SlotSums;
struct ToneDesign;
template <class T>
struct ModuleDesignOf;

/// The loops over a block, in their order.
enum class ChainStage { noise, light, others_light, receiver, pin };
constexpr int chain_stages = 5;

struct ChainKernelInput {
  struct Lane {
    const Burst* bursts = nullptr;
    std::size_t n_bursts = 0;
    std::uint32_t carrier_phase = 0;
    std::array<std::uint32_t, 4> noise_seed{};
    const ModuleDesignOf<float>* module = nullptr;
    const SlotSamples* slots = nullptr;  // for on_slot
    std::size_t n_slots = 0;
    const NoiseWindow* noise_windows = nullptr;
    std::size_t n_noise_windows = 0;
    const MarginWindow* margin_windows = nullptr;
    std::size_t n_margin_windows = 0;
  };
  Lane lane[most_lanes];
  const CarrierDesign* carrier = nullptr;
  float noise_dark = 0, noise_lit = 0;
  /// Light of others; phases at time 0, in 2^-32 cycles.
  struct Tone {
    const ToneDesign* design = nullptr;
    std::uint32_t phase[most_lanes] = {};
  };
  struct Table {
    const float* samples = nullptr;
    std::uint32_t period = 0;
    std::uint32_t phase[most_lanes] = {};
  };
  struct Carrier {
    const CarrierDesign* design = nullptr;
    const float* gain = nullptr;  // knots, or none: always 1 (channel/interference.hpp)
    const Burst* bursts[most_lanes] = {};
    std::size_t n_bursts[most_lanes] = {};
    std::uint32_t phase[most_lanes] = {};
  };
  const Tone* tones = nullptr;
  const Table* tables = nullptr;
  const Carrier* carriers = nullptr;
  std::size_t n_tones = 0, n_tables = 0, n_carriers = 0;
  std::int64_t samples = 0;  // of the longest lane
  /// Called when pins change: at which sample's end, and which lanes (bit i = lane i).
  void (*on_edge)(void* context, std::int64_t sample, std::uint32_t lanes) = nullptr;
  /// If set, no module runs: called at the end of each slot of a lane with its correlation.
  void (*on_slot)(void* context, int lane, const SlotSums& sums) = nullptr;
  /// Whether to give up, asked once a block.
  bool (*stopped)(void* context) = nullptr;
  void* context = nullptr;
  /// If set, called after each loop.
  void (*on_stage)(void* context, ChainStage done) = nullptr;
  void* stage_context = nullptr;
};

/// Samples that a chain makes at a time: few enough to stay in the first-level cache.
constexpr int chain_block = 256;

/// A chain under way: one that goes on while its LEDs are being keyed, by whole blocks.
struct LiveKernel {
  /// The input must outlive it, and have all bursts by the time that they begin.
  void* (*start)(const ChainKernelInput& input);
  void (*advance)(void* chain, std::int64_t end);
  void (*stop)(void* chain);
};

LiveKernel live_lanes_baseline();
LiveKernel live_lanes_v3();
LiveKernel live_lanes_v4();

void run_lanes_baseline(const ChainKernelInput& input);
void run_lanes_v3(const ChainKernelInput& input);  // x86-64-v3: AVX2 and FMA
void run_lanes_v4(const ChainKernelInput& input);  // x86-64-v4: AVX-512, all lanes

}  // namespace channel
