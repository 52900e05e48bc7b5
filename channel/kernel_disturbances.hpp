#pragma once
// The disturbances of trials in the kernels' form, with the memory that it points to.
#include <cstdint>
#include <vector>

#include "channel/chain_kernel.hpp"
#include "channel/disturbance.hpp"
#include "dsp/units.hpp"

namespace channel {

class KernelDisturbances {
 public:
  /// The trial in the next lane; `designs` must outlive this and be the same ones in all lanes.
  void add_lane(const std::vector<Disturbance>& designs,
                const std::vector<DisturbanceInput>& inputs, dsp::Hertz sample_rate);
  /// Shows them to a kernel; to be called behind the last lane.
  void show_to(ChainKernelInput& kernel) const;

 private:
  void add_sources(const std::vector<Disturbance>& designs);
  void load_carrier(ChainKernelInput::Carrier& carrier, const DisturbanceInput& input,
                    dsp::Hertz sample_rate);

  int lanes_ = 0;
  std::vector<ChainKernelInput::Tone> tones_;
  std::vector<ChainKernelInput::Table> tables_;
  std::vector<ChainKernelInput::Carrier> carriers_;
  std::vector<std::vector<Burst>> bursts_;
};

}  // namespace channel
