#pragma once
// What the options of several commands have in common. Checks say what is wrong in the error line;
// the help has its own words, so they have no description.
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "sim/command/commands.hpp"

namespace sim {

constexpr double last_trial = 4294967295;  // trials are numbered in 32 bits

extern const CLI::Validator a_name, an_index, a_shard, a_wire_name;

/// A name of a file or folder, and known as one to completions and the manual (read_usage.hpp).
extern const CLI::Validator a_place;

/// One of some words, which are known there too.
CLI::Validator one_of(const std::vector<std::string>& words);

/// Any text; these are words that are known, beside others.
CLI::Validator likely(const std::vector<std::string>& words);

/// Any text; these are the folders of parts that it may name.
CLI::Validator a_part_of(const std::string& folders);

/// Any text; it is to begin with a key of a scenario.
extern const CLI::Validator a_setting;

/// A whole number from 1 on, written as any number: 1e6.
CLI::Validator a_count(double most);

/// A number within [low, high]; CLI::Range lets NaN pass.
CLI::Validator between(double low, double high);

/// The same, or the word auto.
CLI::Validator auto_or_between(double low, double high);

constexpr double longest_time_s = 1e9;

/// A time with its unit: "90s", "10min", "2h", as seconds; from 0.1 s on.
CLI::Validator a_time(double most_s = longest_time_s);

/// An option or argument that names files or folders.
template <class Place>
CLI::Option* add_place(CLI::App& app, const char* name, Place& place, const char* type,
                       const char* what) {
  return app.add_option(name, place, what)->type_name(type)->check(a_place);
}

/// A short form of --set: `--seed 7` is `--set simulation.seed=7`, and is recorded as such.
void add_short_form(CLI::App& app, const std::string& names, const char* key,
                    std::vector<std::string>& overrides, const std::string& what);

/// Folders of parts that come before the program's own.
void add_part_folders(CLI::App& app, PartRoots& parts);

/// What all commands on a scenario take.
void add_scenario_options(CLI::App& app, ScenarioOptions& options);

/// How captures are read; `what_for` says what the wire is for.
void add_capture_options(CLI::App& app, CaptureOptions& options, const std::string& what_for);

void add_protocol(CLI::App& app, std::string& protocol);
void add_threads(CLI::App& app, int& threads);
void add_amount(CLI::App& app, ScenarioOptions& options);

}  // namespace sim
