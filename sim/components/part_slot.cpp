#include "sim/components/part_slot.hpp"

#include <algorithm>
#include <array>
#include <cassert>

#include "sim/scenario/keys.hpp"

namespace sim {
namespace {

template <auto member>
std::string name_of(const Scenario& s) {
  return (s.*member).name;
}

template <auto member>
void copy_of(const Scenario& from, Scenario& to) {
  to.*member = from.*member;
}

bool always(const Scenario&) { return true; }

bool is_a_module(const Scenario& s) { return !channel::is_matched(s.module); }

template <auto member>
PartSlot slot(std::string ending, std::string folder, bool (*to_be_had)(const Scenario&)) {
  return {std::move(ending), std::move(folder), name_of<member>, copy_of<member>, to_be_had};
}

}  // namespace

const PartSlot& part_slot(const std::string& key) {
  static const std::array slots{
      slot<&Scenario::module>("receiver.module", module_keys().folder, is_a_module),
      slot<&Scenario::emitter>("led.part", led_keys().folder, always),
      slot<&Scenario::floor>("floor.part", floor_keys().folder, always),
      slot<&Scenario::photodiode>(".photodiode", photodiode_keys().folder, always)};
  const auto* const at =
      std::ranges::find_if(slots, [&](const PartSlot& slot) { return key.ends_with(slot.ending); });
  assert(at != slots.end());
  return *at;
}

}  // namespace sim
