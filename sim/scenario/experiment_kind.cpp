#include "sim/scenario/experiment_kind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>

#include "sim/failure.hpp"
#include "sim/scenario/keys.hpp"

namespace sim {
namespace {

std::vector<const ExperimentKind*>& known_kinds() {
  static std::vector<const ExperimentKind*> kinds{&link_kind};
  return kinds;
}

/// Of every experiment.
constexpr std::array<std::string_view, 14> common{
    "title",
    "experiment",
    "led.part",
    "led.current_ma",
    "led.height_mm",
    "led.temperature_c",
    "led.elevation_deg",
    "floor.",
    "receiver.height_mm",
    "receiver.yaw_deg",
    "receiver.tilt_deg",
    "receiver.unit",
    "simulation.seed",
    "stop.rel_ci",
};

/// Of every experiment in which receiver modules hear messages.
constexpr std::array<std::string_view, 12> of_modules{
    "device.baud",
    "device.carrier_hz",
    "device.carrier_duty",
    "module.",
    "uart.",
    "ambient.",
    "noise.",
    "disturbance.",
    "receiver.module",
    "receiver.temperature_c",
    "receiver.supply",
    "simulation.sample_rate_hz",
};

bool begins_with_one(std::string_view key, std::span<const std::string_view> prefixes) {
  return std::ranges::any_of(prefixes, [&](std::string_view prefix) {
    return !prefix.empty() && key.starts_with(prefix);
  });
}

bool has_key(const ExperimentKind& kind, std::string_view key) {
  return begins_with_one(key, common) || begins_with_one(key, kind.tables) ||
         (kind.has_modules && begins_with_one(key, of_modules));
}

/// The experiments that such a key is of.
std::string kinds_with(std::string_view key) {
  std::string names;
  for (const ExperimentKind* kind : known_kinds())
    if (has_key(*kind, key))
      names += fmt::format("{}\"{}\"", names.empty() ? "" : " or ", kind->name);
  return names;
}

std::string remedy(const ExperimentKind& kind, std::string_view key) {
  if (key.starts_with("stop."))
    return fmt::format("set {}, or stop.rel_ci to end at a width of the interval", kind.amount);
  return fmt::format("remove it, or write experiment = {} before the first table", kinds_with(key));
}

}  // namespace

constinit const ExperimentKind link_kind{
    .name = "link",
    .tables = {"device.", "receiver.", "simulation.", "stop.", "led.yaw_deg"},
    .amount = "stop.max_frames",
    .unit = "frames"};

const std::vector<const ExperimentKind*>& experiment_kinds() { return known_kinds(); }

KnownExperimentKind::KnownExperimentKind(const ExperimentKind& kind) : kind_(&kind) {
  known_kinds().push_back(kind_);
}

KnownExperimentKind::~KnownExperimentKind() { std::erase(known_kinds(), kind_); }

const ExperimentKind& kind_of(const Scenario& scenario) {
  return **std::ranges::find(known_kinds(), scenario.experiment, &ExperimentKind::name);
}

std::string amount_key(const Scenario& scenario) { return std::string(kind_of(scenario).amount); }

std::string amount_unit(const Scenario& scenario) { return std::string(kind_of(scenario).unit); }

std::uint32_t runs_asked_for(Scenario scenario) {
  const Key& key = *find_key(amount_key(scenario));
  return static_cast<std::uint32_t>(key.number(scenario));
}

void check_keys_of_experiment(const LoadedScenario& scenario) {
  const ExperimentKind& kind = kind_of(scenario.base);
  for (const auto& [key, place] : scenario.places)
    if (!has_key(kind, key))
      throw bad_input(fmt::format("{} {}", key, place),
                      fmt::format("it means nothing in the experiment \"{}\"", kind.name),
                      remedy(kind, key));
}

}  // namespace sim
