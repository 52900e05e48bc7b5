#pragma once
// LiveScenario: the one point that a line is at, which can be changed while the line runs, key by
// key and by the rules of --set.
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "sim/components/parts.hpp"
#include "sim/link/link.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

/// A scenario as it was when the line began.
struct ScenarioSource {
  std::string text;
  std::filesystem::path path;          // names it in messages
  std::vector<std::string> overrides;  // of the command line
  PartRoots roots;
};

class LiveScenario {
 public:
  /// Throws bad_input for what is no line: a sweep, weighted trials, trials of one message.
  explicit LiveScenario(ScenarioSource source);

  /// "key=value" as of --set, in place of what was set of that key before. Throws bad_input, and
  /// changes nothing, if --set would refuse it, and for keys that say how trials are run.
  void set(const std::string& change);

  /// Of the point as it is now.
  const std::shared_ptr<const Link>& link() const { return link_; }

 private:
  std::shared_ptr<const Link> link_with(const std::vector<std::string>& changes) const;

  ScenarioSource source_;
  std::vector<std::string> changes_;  // since the beginning, one a key
  std::shared_ptr<const Link> link_;
};

}  // namespace sim
