#pragma once
// What a scenario may be an experiment of, and which of the keys then mean something.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sim/scenario/keys.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

struct ExperimentKind {
  std::string_view name;           // "arena"
  std::string_view tables[12];     // keys that it has besides those of all: "path.", "device.baud"
  bool has_modules = true;         // receiver modules and UARTs, with all of their keys
  std::string_view amount;         // the key of how much is simulated: "arena.runs"
  std::string_view unit = "runs";  // what that counts
  std::vector<Key> (*keys)() = nullptr;  // of its own tables; null: none
};

/// A link, which is always known.
extern const ExperimentKind link_kind;

/// A link, and the experiments that are known besides, in the order in which they became known.
const std::vector<const ExperimentKind*>& experiment_kinds();

/// As long as this lives, scenarios may be of an experiment. Not for several threads at once.
class KnownExperimentKind {
 public:
  /// `kind` must outlive the program's last look at a key: it is static.
  explicit KnownExperimentKind(const ExperimentKind& kind);
  ~KnownExperimentKind();
  KnownExperimentKind(const KnownExperimentKind&) = delete;
  KnownExperimentKind& operator=(const KnownExperimentKind&) = delete;

 private:
  const ExperimentKind* kind_;
};

/// The key of how much of a point is simulated: "arena.runs"; of a link "stop.max_frames".
std::string amount_key(const Scenario& scenario);

/// What it counts: "frames" of a link, "runs" of others.
std::string amount_unit(const Scenario& scenario);

/// How many frames, runs or trials a point shall have, by that key.
std::uint32_t runs_asked_for(Scenario scenario);

/// That of a scenario.
const ExperimentKind& kind_of(const Scenario& scenario);

/// Throws where the file or --set gives a key that means nothing in the scenario's experiment.
void check_keys_of_experiment(const LoadedScenario& scenario);

}  // namespace sim
