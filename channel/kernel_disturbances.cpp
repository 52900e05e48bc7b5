#include "channel/kernel_disturbances.hpp"

#include <cassert>

#include "channel/bursts.hpp"

namespace channel {

void KernelDisturbances::add_sources(const std::vector<Disturbance>& designs) {
  for (const Disturbance& design : designs) {
    for (const ToneDesign& tone : design.tones) tones_.push_back({.design = &tone});
    if (!design.table.empty())
      tables_.push_back(
          {.samples = design.table.data(),
           .period = static_cast<std::uint32_t>(design.table.size()) - longest_interference_block});
    if (design.carrier)
      carriers_.push_back(
          {.design = &*design.carrier, .gain = design.gain.empty() ? nullptr : design.gain.data()});
  }
}

void KernelDisturbances::add_lane(const std::vector<Disturbance>& designs,
                                  const std::vector<DisturbanceInput>& inputs,
                                  dsp::Hertz sample_rate) {
  assert(designs.size() == inputs.size());
  if (lanes_ == 0) add_sources(designs);
  auto tone = tones_.begin();
  auto table = tables_.begin();
  auto carrier = carriers_.begin();
  for (std::size_t i = 0; i < designs.size(); ++i) {
    for (std::size_t k = 0; k < designs[i].tones.size(); ++k)
      (tone++)->phase[lanes_] = inputs[i].phase[1];
    if (!designs[i].table.empty()) (table++)->phase[lanes_] = inputs[i].phase[0];
    if (designs[i].carrier) load_carrier(*carrier++, inputs[i], sample_rate);
  }
  ++lanes_;
}

void KernelDisturbances::load_carrier(ChainKernelInput::Carrier& carrier,
                                      const DisturbanceInput& input, dsp::Hertz sample_rate) {
  bursts_.push_back(bursts_of(input.drive, sample_rate));
  carrier.bursts[lanes_] = bursts_.back().data();
  carrier.n_bursts[lanes_] = bursts_.back().size();
  carrier.phase[lanes_] = input.phase[0];
}

void KernelDisturbances::show_to(ChainKernelInput& kernel) const {
  kernel.tones = tones_.data();
  kernel.tables = tables_.data();
  kernel.carriers = carriers_.data();
  kernel.n_tones = tones_.size();
  kernel.n_tables = tables_.size();
  kernel.n_carriers = carriers_.size();
}

}  // namespace channel
