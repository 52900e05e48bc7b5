#pragma once
// What a check says: to people, to programs (JSON), and to CI servers (JUnit).
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/check/point_check.hpp"

namespace sim {

struct CheckReport {
  const std::vector<PointCheck>& checks;
  const CheckSetup& setup;
  const Baseline& baseline;
  std::filesystem::path baseline_file;
  // Of the command, as a shell takes them: all but scenarios and --point; those that change
  // scenarios.
  std::string options, scenario_options;

  /// Points with that verdict.
  std::size_t count(Verdict verdict) const;
};

std::string check_text(const CheckReport& report);
std::string check_json(const CheckReport& report);
/// A row a point, for a file of that name (.csv, .json).
std::string check_table(const std::filesystem::path& place, const CheckReport& report);
bool is_check_table(const std::filesystem::path& path);
/// A test case a point; valid by the schema of Jenkins' xunit plugin, junit-10.xsd.
std::string check_junit(const CheckReport& report);
/// Whether such a file was written by it.
bool is_check_junit(const std::filesystem::path& path);

/// Markdown for a page of a CI server: verdict, table, and three frames as pictures of characters.
std::string check_summary(const CheckReport& report);
/// Whether such a file was written by it.
bool is_check_summary(const std::filesystem::path& path);

const char* name(Verdict verdict);

/// What follows from all points, a line.
std::string verdict_line(const CheckReport& report);
/// The check of this point alone, as a shell takes it.
std::string repeat_command(const CheckReport& report, const PointCheck& check);

/// What is known of a point, in some lines of text, the commands among them.
std::string point_details(const CheckReport& report, const PointCheck& check);

}  // namespace sim
