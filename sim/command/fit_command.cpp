// `cosys-sim fit`: the constants of a receiver module, measured, or what to measure them by.
#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string_view>

#include "sim/command/commands.hpp"

namespace sim {
namespace {

constexpr std::string_view of_captures[] = {
    "--irradiance", "--ambient",     "--page",      "--json",      "--quiet",       "--drive",
    "--message",    "--baud",        "--carrier",   "--polarity",  "--wire",        "--channel",
    "--format",     "--sample-rate", "--time-unit", "--skip-rows", "--sample-bytes"};
constexpr std::string_view of_benches[] = {"--minutes"};

/// Options that would not be heeded.
void refuse_fitting(std::span<const std::string_view> names, const FitRequest& request,
                    const std::string& with, const char* suggestion) {
  for (const std::string_view name : names)
    if (std::ranges::find(request.given, name) != request.given.end())
      throw bad_input(fmt::format("{} {}", name, with),
                      request.captures.empty() ? "it is for captures" : "it is for a bench",
                      suggestion);
}

void refuse_no_capture(const FitRequest& request) {
  const char* how = "write cosys-sim fit CAPTURE, or cosys-sim fit --plan -o FOLDER";
  if (!request.plan) throw bad_input("fit", "it is given no capture, and no --plan", how);
  if (!request.plan_files.empty())
    throw bad_input("--plan " + request.plan_files.front().string(), "no capture of it is given",
                    how);
  refuse_fitting(of_captures, request, "without a capture", "leave it out, or name a capture");
  if (!request.output)
    throw bad_input("fit --plan", "it has no folder to write to",
                    "write cosys-sim fit --plan -o FOLDER");
  if (request.output->extension() == ".toml")
    throw bad_input("--output " + request.output->string(), "it is to be a folder",
                    "name one, such as bench");
}

/// `what`: "--plan"; `words`: "plans".
void refuse_other_number(const FitRequest& request, const char* what, const char* words,
                         std::size_t number, bool may_be_one) {
  const std::size_t captures = request.captures.size();
  if (number == 0 || number == captures || (may_be_one && number == 1)) return;
  throw bad_input(
      fmt::format("{}: {} {} for {} captures", what, number, words, captures),
      fmt::format("each capture has one of its own{}", may_be_one ? ", or all one" : ""),
      fmt::format("name {}{}", captures, may_be_one ? ", or one" : ""));
}

void refuse_other_numbers(const FitRequest& request) {
  refuse_other_number(request, "--plan", "plans", request.plan_files.size(), true);
  refuse_other_number(request, "--irradiance", "numbers", request.irradiances_mw_per_m2.size(),
                      true);
  refuse_other_number(request, "--ambient", "numbers", request.ambients_w_per_m2.size(), false);
  if (!request.ambients_w_per_m2.empty() && request.ambients_w_per_m2.front() != 0)
    throw bad_input("--ambient", "the first capture is under a lamp, too",
                    "name one without a lamp first, with 0");
  if (request.captures.size() > 1 && std::ranges::count(request.captures, "-") > 0)
    throw bad_input("-", "one of several captures cannot be standard input", "save it to a file");
}

void refuse_bench_of_capture(const FitRequest& request) {
  refuse_fitting(of_benches, request, "with a capture", "leave it out");
  if (request.plan && request.plan_files.empty())
    throw bad_input("--plan with a capture", "it names no plan",
                    "write --plan PLAN, or leave it out where plan.txt is beside the capture");
  refuse_other_numbers(request);
}

}  // namespace

ExitCode fit_command(const FitRequest& request) {
  if (request.captures.empty()) {
    refuse_no_capture(request);
    return bench_command(request);
  }
  refuse_bench_of_capture(request);
  return measure_command(request);
}

}  // namespace sim
