#include "sim/command/command_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "sim/command/read_usage.hpp"
#include "sim/counting/shard.hpp"
#include "sim/loading/parsed_scenario.hpp"
#include "sim/scenario/key_check.hpp"
#include "sim/scenario/keys.hpp"
#include "sim/scenario/sweep.hpp"
#include "sim/text/number_text.hpp"
#include "sim/trial/wire_protocols.hpp"

namespace sim {
namespace {

/// Takes any text, and is there for its name.
CLI::Validator known_by(const std::string& name) {
  return {[](const std::string&) { return std::string(); }, "", name};
}

/// Throws for what --set would refuse, but under the name of the option that was typed.
void check_short_form(const std::string& name, const std::string& value, const std::string& place) {
  const Key& key = *find_key(name);
  const std::string problem = name + " = " + value + " " + place;
  const bool whole = key.facts.type == KeyType::whole_number;
  if (!parse_number(value) && !is_range_or_list(value))
    throw bad_input(
        problem, "not a number",
        std::string("use a ") + (whole ? "whole " : "") + "number " + in_words(key.facts.range));
  make_axis(key, parse_values(value, problem), place);
}

}  // namespace

const CLI::Validator a_name([](const std::string& text) { return text.empty() ? "is empty" : ""; },
                            "");
const CLI::Validator a_place = a_name.name(std::string(place_check));
const CLI::Validator an_index(
    [](const std::string& text) {
      const bool digits = text.find_first_not_of("0123456789") == std::string::npos;
      return digits && !text.empty() ? "" : text + " is not a whole number, counted from 0";
    },
    "");

const CLI::Validator a_wire_name(
    [](const std::string& text) {
      const bool known = text.find_first_not_of(
                             "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                             "0123456789_.-[]") == std::string::npos;
      return known && !text.empty() ? "" : text + " is no name of a wire such as iogD_2";
    },
    "");

const CLI::Validator a_shard(
    [](const std::string& text) {
      return parse_shard(text)
                 ? ""
                 : fmt::format("{} is no shard K/N, with K from 1 to N and N up to {}", text,
                               most_shards);
    },
    "");

CLI::Validator one_of(const std::vector<std::string>& words) {
  return CLI::IsMember(words).description("").name(
      fmt::format("{} {}", words_check, fmt::join(words, " ")));
}

CLI::Validator likely(const std::vector<std::string>& words) {
  return known_by(fmt::format("{} {}", some_words_check, fmt::join(words, " ")));
}

CLI::Validator a_part_of(const std::string& folders) {
  return known_by(fmt::format("{} {}", part_check, folders));
}

const CLI::Validator a_setting = known_by(std::string(key_check));

CLI::Validator a_count(double most) {
  return {[=](const std::string& text) {
            const auto count = parse_number(text);
            const bool known =
                count && *count >= 1 && *count <= most && *count == std::floor(*count);
            return known ? "" : fmt::format("{} is no whole number from 1 to {:.0f}", text, most);
          },
          ""};
}

CLI::Validator between(double low, double high) {
  return {[=](const std::string& text) {
            const auto value = parse_number(text);
            const bool inside = value && *value >= low && *value <= high;
            return inside ? "" : fmt::format("{} is no number from {} to {}", text, low, high);
          },
          ""};
}

CLI::Validator auto_or_between(double low, double high) {
  return {[number = between(low, high)](const std::string& text) {
            return text == "auto" ? std::string() : number(text);
          },
          ""};
}

CLI::Validator a_time(double most_s) {
  return {
      [most_s](std::string& text) -> std::string {
        static const std::map<std::string, double> seconds_in{{"s", 1}, {"min", 60}, {"h", 3600}};
        const std::size_t unit = std::min(text.find_last_of("0123456789.") + 1, text.size());
        const auto number = parse_number(text.substr(0, unit));
        const auto seconds = seconds_in.find(text.substr(unit));
        const bool known = number && seconds != seconds_in.end();
        const double time = known ? *number * seconds->second : 0;
        if (!(time >= 0.1 && time <= most_s))
          return text +
                 (most_s < longest_time_s
                      ? fmt::format(" is no time such as 1s or 2min, from 0.1s to {}s", most_s)
                      : " is no time such as 90s, 10min or 2h, from 0.1s on");
        text = fmt::format("{}", time);
        return "";
      },
      ""};
}

void add_short_form(CLI::App& app, const std::string& names, const char* key,
                    std::vector<std::string>& overrides, const std::string& what) {
  const std::string place = "in " + names.substr(names.find("--"));
  app.add_option_function<std::string>(
         names,
         [&overrides, key, place](const std::string& value) {
           check_short_form(key, value, place);
           overrides.push_back(std::string(key) + "=" + value);
         },
         what + " (the key " + key + ")")
      ->type_name("N");
}

void add_part_folders(CLI::App& app, PartRoots& parts) {
  app.add_option("--parts", parts,
                 "a folder with modules/, leds/, floors/ or photodiodes/ of your own; may be given "
                 "several times")
      ->type_name("DIR")
      ->expected(1)
      ->check(CLI::ExistingDirectory.description("").name(std::string(place_check)))
      ->take_all();
}

void add_scenario_options(CLI::App& app, ScenarioOptions& options) {
  app.add_option("--set", options.overrides,
                 "change a key of the scenario: receiver.range_m=3, a range or list sweeps it: "
                 "receiver.range_m=1:0.5:20 or =1,2,5; may be given several times")
      ->type_name("KEY=VALUE")
      ->check(a_setting)
      ->expected(1)
      ->take_all();
  add_part_folders(app, options.parts);
  add_short_form(app, "-S,--seed", "simulation.seed", options.overrides, "seed of all randomness");
}

void add_protocol(CLI::App& app, std::string& protocol) {
  app.add_option("--protocol", protocol,
                 fmt::format("format of the messages: {}; cosys if not given",
                             fmt::join(wire_protocol_names(), " or ")))
      ->type_name("NAME")
      ->check(one_of(wire_protocol_names()));
}

void add_threads(CLI::App& app, int& threads) {
  app.add_option("-t,--threads", threads,
                 "threads, 1 to 1024; if not given, one for each processor; the results are the "
                 "same for any number")
      ->type_name("N")
      ->check(CLI::Range(1, 1024).description(""));
}

void add_amount(CLI::App& app, ScenarioOptions& options) {
  const std::string names = "-n,--max-frames";
  app.add_option_function<std::string>(
         names,
         [&options](const std::string& value) {
           check_short_form("stop.max_frames", value, "in --max-frames");
           options.overrides.push_back(std::string(amount_option) + value);
         },
         "frames after which a point is finished (the key stop.max_frames); of other experiments "
         "runs (arena.runs) or windows (presence.trials)")
      ->type_name("N");
}

}  // namespace sim
