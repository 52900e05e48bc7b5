// `cosys-sim find`: where along a key does the frame loss pass a level?
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "sim/columns/closing_lines.hpp"
#include "sim/columns/columns_table.hpp"
#include "sim/command/commands.hpp"
#include "sim/engine/checkpointer.hpp"
#include "sim/engine/search.hpp"
#include "sim/failure.hpp"
#include "sim/link/link.hpp"
#include "sim/link_experiment/link_columns.hpp"
#include "sim/link_experiment/link_json.hpp"
#include "sim/link_experiment/link_measurement.hpp"
#include "sim/link_experiment/link_notes.hpp"
#include "sim/loading/load_scenario.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/report/finished_result.hpp"
#include "sim/result/alarms.hpp"
#include "sim/result/store.hpp"
#include "sim/result/unfinished.hpp"
#include "sim/scenario/keys.hpp"
#include "sim/scenario/method.hpp"
#include "sim/scenario/scenario_key.hpp"
#include "sim/scenario/sweep.hpp"
#include "sim/text/list_text.hpp"
#include "sim/text/number_text.hpp"
#include "sim/text/quantity.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/threads/stop_signals.hpp"
#include "sim/threads/worker_threads.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

using Coordinates = std::vector<double>;

/// Frames enough to tell a loss of half or twice the level from it.
double enough_frames(double flr) { return std::min(4e9, std::ceil(50 / flr)); }

/// The key and its values behind "--over": "receiver.range_m=1:40", or the key alone.
struct Over {
  std::string key;
  bool whole_numbers;
  double low, high;
};

Failure wrong_over(const std::string& text, const std::string& why) {
  return bad_input("--over " + text, why,
                   "write KEY=LOW:HIGH, such as receiver.range_m=1:40, or KEY if the scenario "
                   "sweeps it");
}

/// The ends of the scenario's own sweep of the key.
std::vector<double> swept_ends(const std::string& text, const LoadedScenario& scenario) {
  const auto axis = std::ranges::find(scenario.sweep, text, &Axis::key);
  if (axis == scenario.sweep.end()) throw wrong_over(text, "the scenario does not sweep it");
  const auto [low, high] = std::ranges::minmax(axis->values);
  return {low, high};
}

/// Those of "1:40".
std::vector<double> given_ends(const std::string& text, const std::string& range, const Key& key) {
  const std::string numbers = in_unit(range, key.facts.unit, "--over " + text);
  std::vector<double> ends;
  for (const std::string_view end : split(numbers, ':'))
    if (const auto value = parse_number(end); value && std::isfinite(*value))
      ends.push_back(*value);
  if (ends.size() != 2 || std::ranges::count(numbers, ':') != 1)
    throw wrong_over(text, "not two numbers with a colon between");
  return ends;
}

Over over_of(const std::string& text, const LoadedScenario& scenario) {
  const std::size_t equals = text.find('=');
  const bool is_given = equals != std::string::npos;
  const std::string range = is_given ? text.substr(equals + 1) : "";
  const Key& key = scenario_key(text.substr(0, equals), range, "in --over");
  if (key.name().starts_with("stop.") || key.name() == "simulation.seed")
    throw wrong_over(text, "no loss depends on it");
  if (!key.is_number()) throw wrong_over(text, "its values are no numbers");
  const auto ends = is_given ? given_ends(text, range, key) : swept_ends(text, scenario);
  const auto [low, high] = std::ranges::minmax(ends);
  if (!(low < high)) throw wrong_over(text, "both ends are the same");
  return {key.name(), key.facts.type == KeyType::whole_number, low, high};
}

/// What the search runs: the user's scenario, with points stopped as soon as their side is told.
LoadedScenario load_for_search(const FindRequest& request) {
  refuse_weighted(load_link(request.options, request.scenario, "find").base,
                  "find tells losses from a level frame by frame");
  ScenarioOptions options{{fmt::format("stop.max_frames={}", enough_frames(request.flr)),
                           "stop.max_frame_errors=0", "stop.rel_ci=0"},
                          request.options.parts};
  std::ranges::copy(request.options.overrides, std::back_inserter(options.overrides));
  options.overrides.push_back(fmt::format("stop.target_flr={}", request.flr));
  return load_link(options, request.scenario, "find");
}

/// The same with the key swept over these values. Its text carries the parts, so no file is read
/// again: what was counted belongs to what was read first.
LoadedScenario swept_over(const LoadedScenario& scenario, const std::string& key,
                          const std::set<double>& values) {
  return parse_scenario(scenario.text, scenario.path,
                        {fmt::format("{}={}", key, fmt::join(values, ","))}, {});
}

/// All that was counted, in the order of its counting in the table and of the grid in the file.
class Finds {
 public:
  Finds(const FindRequest& request, const Over& over, const LoadedScenario& scenario,
        fs::path output, const std::atomic<bool>& interrupt)
      : request_(request),
        over_(over),
        scenario_(scenario),
        ends_(swept_over(scenario, over.key, {over.low, over.high})),
        table_(link_columns(), ends_, {}, terminal_columns()),
        output_(std::move(output)),
        interrupt_(interrupt),
        axis_(static_cast<std::size_t>(std::ranges::find(ends_.sweep, over.key, &Axis::key) -
                                       ends_.sweep.begin())) {}

  void run() {
    if (!request_.json) print(table_.head());
    for (std::size_t i = 0; i < count_points(ends_.sweep) && !interrupt_; ++i) {
      Coordinates at = point_coordinates(ends_.sweep, i);
      if (at[axis_] != over_.low) continue;  // the search's first end stands for the others
      const auto count = [&](double value) { return count_at(at, value); };
      search({over_.low, over_.high, request_.tolerance, over_.whole_numbers}, request_.flr, count);
    }
    if (!request_.json) print(left_out_note(table_.left_out(), "a wider terminal"));
  }

  CrossingQuestion question() const { return {request_.flr, over_.key}; }

  /// As a sweep over all values that were looked at; a point that was not is unfinished.
  LinkResult result() const {
    std::set<double> values{over_.low, over_.high};
    for (const auto& [coordinates, point] : counted_) values.insert(coordinates[axis_]);
    LinkResult result = unfinished(swept_over(scenario_, over_.key, values), request_.command);
    for (LinkPoint& point : result.points) {
      const auto known = counted_.find(point.coordinates);
      if (known != counted_.end()) point = known->second;
    }
    add_row_alarms(result, question());
    return result;
  }

 private:
  void keep_result() {
    checkpointer_.keep([&] { write_dataset(output_, link_dataset(result()), request_.program); });
  }

  std::optional<Tally> count_at(Coordinates at, double value) {
    at[axis_] = value;
    const Scenario scenario = checked_point(ends_, at);
    const auto keep = [&](LinkPoint point, bool due) {
      point.coordinates = at;
      counted_[at] = std::move(point);
      if (due) keep_result();
    };
    keep(run_point(make_link(scenario), rule_of(scenario.stop),
                   {.threads = threads_for(request_.threads), .interrupt = &interrupt_},
                   [&](const LinkPoint& p) { keep(p, checkpointer_.is_due()); }),
         false);
    if (!request_.json) print(table_.row(counted_[at]));
    if (checkpointer_.is_due_at_end()) keep_result();
    if (interrupt_) return std::nullopt;
    return counted_[at].tally;
  }

  const FindRequest& request_;
  const Over over_;
  const LoadedScenario& scenario_;
  const LoadedScenario ends_;  // swept over both ends of the range
  const PointTable<LinkPoint> table_;
  const fs::path output_;
  Checkpointer checkpointer_;
  const std::atomic<bool>& interrupt_;
  const std::size_t axis_;
  std::map<Coordinates, LinkPoint> counted_;
};

fs::path found_output(const FindRequest& request) {
  return request.output.value_or(request.scenario.stem().concat("-find.h5"));
}

}  // namespace

ExitCode find_command(const FindRequest& request) {
  const LoadedScenario scenario = load_for_search(request);
  const Over over = over_of(request.over, scenario);
  const fs::path output = found_output(request);
  check_writable(output);
  const std::atomic<bool>& interrupt = heed_stop_signals();
  Finds finds(request, over, scenario, output, interrupt);
  const auto json_of = [&](const LinkResult& result) {
    return to_json(result, link_dataset(result), rank(result, finds.question()));
  };
  const auto keep_all = [&](const LinkResult& result) {
    keep_finished(
        output,
        [&](const fs::path& place) { write_dataset(place, link_dataset(result), request.program); },
        [&] { return json_of(result); });
  };
  try {
    finds.run();
  } catch (const Failure&) {
    keep_all(finds.result());
    throw;
  }
  const LinkResult result = finds.result();
  keep_all(result);
  if (request.json)
    print_json(json_of(result) + "\n");
  else
    print((interrupt ? "interrupted: what follows is of what was counted\n" : "") +
          link_notes(result, rank(result, finds.question())) +
          kept_line(output, result_digest(result)));
  if (!interrupt) return ExitCode::done;
  say("cosys-sim: interrupted (by a signal) what was counted is in the result file\n");
  return ExitCode::interrupted;
}

}  // namespace sim
