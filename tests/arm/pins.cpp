// The pins that eight noisy trials give, in eight lanes and alone, as text: the same on every
// processor, which tests/arm/run compares.
#include <cstdint>
#include <cstdio>
#include <vector>

#include "channel/chain.hpp"
#include "dsp/philox.hpp"

namespace {

constexpr dsp::Hertz sample_rate(600e3);
constexpr int trials = 8;
constexpr int bits = 60;

/// Random bits at 600 Bd, dark before and behind.
dsp::LogicTrace wire_of(std::uint32_t trial) {
  const dsp::RandomAddress draws{.seed = 1, .point = 0, .trial = trial, .purpose = 1};
  dsp::LogicTrace wire(true);
  for (std::uint32_t i = 0; i < bits; ++i)
    wire.set_at(dsp::Seconds(5e-3 + i / 600.0), draws.uniform(i) < 0.5);
  wire.set_at(dsp::Seconds(5e-3 + bits / 600.0), true);
  wire.observe_until(dsp::Seconds(10e-3 + bits / 600.0));
  return wire;
}

void print(const char* name, const dsp::LogicTrace& pin) {
  std::printf("%s", name);
  for (const dsp::Seconds edge : pin.edges()) std::printf(" %.0f", edge.value * sample_rate.value);
  std::printf("\n");
}

void print_pins(double irradiance_mw_per_m2) {
  const channel::ChainDesign design =
      channel::design_chain(channel::ModuleData{},
                            {.signal = dsp::WattsPerSquareMetre(irradiance_mw_per_m2 * 1e-3),
                             .ambient = dsp::WattsPerSquareMetre(5),
                             .carrier = dsp::Hertz(59e3)},
                            sample_rate);
  std::vector<dsp::LogicTrace> wires;
  for (std::uint32_t i = 0; i < trials; ++i) wires.push_back(wire_of(i));
  std::vector<channel::ChainInput> inputs;
  for (std::uint32_t i = 0; i < trials; ++i)
    inputs.push_back({&wires[i], i * 536870912u, {i, 1, 2, 3}});
  for (const dsp::LogicTrace& pin : channel::propagate(design, inputs)) print("lane ", pin);
  for (const channel::ChainInput& input : inputs)
    print("alone", channel::propagate_alone(design, input));
}

}  // namespace

int main() {
  for (const double irradiance : {0.5, 1.0, 30.0}) print_pins(irradiance);
}
