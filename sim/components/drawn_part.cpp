#include "sim/components/drawn_part.hpp"

#include <algorithm>

#include "channel/conditions.hpp"
#include "sim/scenario/experiment_kind.hpp"
#include "sim/scenario/keys.hpp"
#include "sim/text/digest.hpp"

namespace sim {
namespace {

/// What sets the draws of units apart from those of trials, which count their purposes from 1.
constexpr std::uint32_t purpose_of_units = 0x756e6974;

template <class Data>
const PartNumber<Data>& number_named(const PartKeys<Data>& keys, const std::string& name) {
  return *std::ranges::find(keys.numbers, name, [](const auto& n) { return n.facts.name; });
}

template <class Data>
void draw_numbers(Data& part, const PartKeys<Data>& keys, const dsp::RandomAddress& draws) {
  for (const channel::NumberBounds& bounds : part.bounds) {
    const auto index = static_cast<std::uint32_t>(hash_of(keys.folder + "." + bounds.number));
    part.*number_named(keys, bounds.number).member = quantile(bounds, draws.uniform(index));
  }
}

template <class Data>
void add_numbers(std::vector<DrawnNumber>& numbers, const Data& part, const PartKeys<Data>& keys,
                 const std::string& table) {
  for (const channel::NumberBounds& bounds : part.bounds) {
    const PartNumber<Data>& number = number_named(keys, bounds.number);
    numbers.push_back({table + "." + bounds.number, number.facts.unit, part.*number.member});
  }
}

template <class Data>
void forget(Data& part, const std::string& table, const SourceLocations& places) {
  std::erase_if(part.bounds, [&](const channel::NumberBounds& bounds) {
    return places.contains(table + "." + bounds.number);
  });
}

}  // namespace

channel::ModuleData with_drawn_numbers(channel::ModuleData module,
                                       const dsp::RandomAddress& draws) {
  draw_numbers(module, module_keys(), draws);
  if (module.emin_max_mw_per_m2 > 0)
    module.emin_max_mw_per_m2 = std::max(module.emin_max_mw_per_m2, module.emin_mw_per_m2);
  return module;
}

channel::ModuleData drawn_unit(const channel::ModuleData& module, const dsp::RandomAddress& draws) {
  return channel::unit_of(with_drawn_numbers(module, draws), draws.uniform(0), draws.uniform(1));
}

bool has_unlike_units(const Scenario& scenario) {
  if (kind_of(scenario).has_modules) return !channel::is_matched(scenario.module);
  return !scenario.emitter.bounds.empty() || !scenario.floor.bounds.empty();
}

std::vector<DrawnNumber> drawn_numbers(const Scenario& scenario) {
  std::vector<DrawnNumber> numbers;
  for (const char* of_a_unit : {"centre_hz", "emin_mw_per_m2"}) {
    if (std::ranges::count(scenario.module.bounds, of_a_unit, &channel::NumberBounds::number) > 0)
      continue;  // it is among those
    const auto& number = number_named(module_keys(), of_a_unit);
    numbers.push_back(
        {std::string("module.") + of_a_unit, number.facts.unit, scenario.module.*number.member});
  }
  add_numbers(numbers, scenario.module, module_keys(), "module");
  add_numbers(numbers, scenario.emitter, led_keys(), "led");
  for (const auto& [name, device] : scenario.devices)
    add_numbers(numbers, device.emitter, led_keys(), "devices." + name + ".led");
  add_numbers(numbers, scenario.floor, floor_keys(), "floor");
  return numbers;
}

void forget_given_bounds(Scenario& scenario, const SourceLocations& places) {
  forget(scenario.module, "module", places);
  forget(scenario.floor, "floor", places);
}

bool is_drawn_by_point(const std::vector<Axis>& sweep) {
  return std::ranges::any_of(sweep, [](const Axis& axis) {
    return axis.key == unit_key || axis.key == "simulation.seed";
  });
}

void place_unit(Scenario& scenario) {
  if (scenario.receiver.unit == 0) return;
  const dsp::RandomAddress draws{.seed = static_cast<std::uint64_t>(scenario.simulation.seed),
                                 .point = 0,
                                 .trial = static_cast<std::uint32_t>(scenario.receiver.unit),
                                 .purpose = purpose_of_units};
  scenario.module = drawn_unit(scenario.module, draws);
  draw_numbers(scenario.emitter, led_keys(), draws);
  for (auto& [name, device] : scenario.devices) draw_numbers(device.emitter, led_keys(), draws);
  draw_numbers(scenario.floor, floor_keys(), draws);
}

}  // namespace sim
