#include "sim/guard/guard_experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "protocol/shared_node.hpp"
#include "sim/arena/arena_run.hpp"
#include "sim/failure.hpp"
#include "sim/guard/mirror.hpp"
#include "sim/point_scenario.hpp"
#include "sim/run_sharing.hpp"
#include "sim/sweep.hpp"
#include "sim/trial.hpp"

namespace sim {
namespace {

std::string first_word(const std::string& message) { return message.substr(0, message.find(' ')); }

[[noreturn]] void refuse_messages(const Sender& sender, const std::string& message,
                                  const std::string& why, const std::string& suggestion) {
  throw bad_input(fmt::format("devices.{}.messages = \"{}\"", sender.kind, message), why,
                  suggestion);
}

/// "By convention the first word identifies the device": it names its variable.
std::string variable_of(const Sender& sender) {
  const std::string name = first_word(sender.messages.front());
  for (const std::string& message : sender.messages) {
    if (first_word(message) != name || name.empty())
      refuse_messages(sender, message, "its first word is the name by which the guard knows it",
                      "begin all messages of a device with one word");
    if (const auto problem = protocol::problem_in_text(message))
      refuse_messages(sender, message, "SharedLink cannot carry it: " + *problem,
                      "use other characters");
  }
  return name;
}

std::vector<std::string> variables_of(const std::vector<Sender>& senders) {
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (const Sender& sender : senders) {
    names.push_back(variable_of(sender));
    if (!seen.insert(names.back()).second)
      refuse_messages(sender, sender.messages.front(),
                      "another device's messages begin with this word too",
                      "give each a word of its own; {} is its number");
  }
  return names;
}

void check_list(const std::vector<std::string>& variables, const std::vector<Sender>& senders) {
  protocol::SharedNode node({.outbound = variables});
  for (std::size_t i = 0; i < senders.size(); ++i)
    for (const std::string& message : senders[i].messages)
      if (const auto problem = node.set(
              i,
              message +
                  std::string(senders[i].source == MessageSource::counter ? counter_size : 0, '0')))
        refuse_messages(senders[i], message, "no value of a shared list: " + *problem,
                        "shorten it");
}

MirrorDesign mirror_design(const Scenario& scenario, const Arena& arena) {
  MirrorDesign design{.variables = variables_of(arena.senders),
                      .settings = scenario.guard,
                      .duration = arena.duration,
                      .delay = arena.delay};
  check_list(design.variables, arena.senders);
  return design;
}

struct GuardRuns {
  ArenaRuns arena;
  GuardTally tally;
};

GuardRuns run_lot(const Arena& arena, const MirrorDesign& design, std::uint32_t first, int n,
                  const std::atomic<bool>* stop) {
  GuardRuns runs{run_arena(arena, first, n, stop), {}};
  for (std::uint32_t run = first; run < first + static_cast<std::uint32_t>(n); ++run) {
    const auto heard = std::ranges::equal_range(runs.arena.heard, run, {}, &HeardFrame::run);
    runs.tally += mirror(design, heard,
                         {.seed = arena.seed,
                          .point = arena.point,
                          .trial = run,
                          .purpose = static_cast<std::uint32_t>(Purpose::serial_line)});
  }
  return runs;
}

GuardPoint run_point(const Scenario& scenario, const std::vector<double>& coordinates,
                     const GuardOptions& options) {
  const Arena arena = make_arena(scenario);
  const MirrorDesign design = mirror_design(scenario, arena);
  GuardPoint point{arena_point(arena, coordinates), design.variables, {}};
  RunSharing<GuardRuns> sharing(static_cast<std::uint32_t>(scenario.arena.runs), options.threads,
                                options.interrupt, [&](std::uint32_t first, int n) {
                                  return run_lot(arena, design, first, n, options.interrupt);
                                });
  auto lots = sharing();
  if (!lots) return point;
  for (GuardRuns& lot : *lots) {
    add_runs(point.arena, std::move(lot.arena));
    point.tally += lot.tally;
  }
  return point;
}

}  // namespace

MirrorTally together(const GuardPoint& point) {
  MirrorTally sum;
  for (const MirrorTally& mirror : point.tally.mirrors) sum += mirror;
  return sum;
}

std::vector<GuardPoint> run_guards(const LoadedScenario& scenario, const GuardOptions& options) {
  std::vector<GuardPoint> points(count_points(scenario.sweep));
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].arena.coordinates = point_coordinates(scenario.sweep, i);
    if (options.interrupt != nullptr && *options.interrupt) continue;
    const auto& coordinates = points[i].arena.coordinates;
    points[i] = run_point(point_scenario(scenario, coordinates), coordinates, options);
    if (options.on_point && points[i].arena.tally.n_runs > 0) options.on_point(points[i]);
  }
  return points;
}

}  // namespace sim
