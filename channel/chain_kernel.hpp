#pragma once
// The border between the chain and its kernels. A kernel is one translation unit built for one
// instruction set; only plain data and function pointers cross, so that no inline code of one set
// is ever linked into another (a test looks at the symbols).
#include <array>
#include <cstddef>
#include <cstdint>

namespace channel {

struct Burst;
struct CarrierDesign;
struct ModuleDesign;

struct ChainKernelInput {
  struct Lane {
    const Burst* bursts = nullptr;
    std::size_t n_bursts = 0;
    std::uint32_t carrier_phase = 0;
    std::array<std::uint32_t, 4> noise_seed{};
  };
  Lane lane[8];
  const CarrierDesign* carrier = nullptr;
  const ModuleDesign* module = nullptr;
  float noise_dark = 0, noise_lit = 0;
  std::int64_t samples = 0;  // of the longest lane
  /// Called when pins change: at which sample's end, and which lanes (bit i = lane i).
  void (*on_flip)(void* context, std::int64_t sample, std::uint32_t lanes) = nullptr;
  /// Whether to give up, asked once a block.
  bool (*stopped)(void* context) = nullptr;
  void* context = nullptr;
};

void run_lanes_baseline(const ChainKernelInput& input);
void run_lanes_v3(const ChainKernelInput& input);  // x86-64-v3: AVX2 and FMA

}  // namespace channel
