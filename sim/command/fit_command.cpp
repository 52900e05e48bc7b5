// `cosys-sim fit`: the constants of a receiver module, measured, or what to measure them by.
#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string_view>

#include "sim/command/commands.hpp"

namespace sim {
namespace {

constexpr std::string_view of_captures[] = {
    "--irradiance",  "--page",      "--json",      "--quiet",       "--drive",
    "--carrier",     "--polarity",  "--wire",      "--channel",     "--format",
    "--sample-rate", "--time-unit", "--skip-rows", "--sample-bytes"};
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
  if (!request.plan_file.empty())
    throw bad_input("--plan " + request.plan_file.string(), "no capture of it is given", how);
  refuse_fitting(of_captures, request, "without a capture", "leave it out, or name a capture");
  if (!request.output)
    throw bad_input("fit --plan", "it has no folder to write to",
                    "write cosys-sim fit --plan -o FOLDER");
}

void refuse_bench_of_capture(const FitRequest& request) {
  refuse_fitting(of_benches, request, "with a capture", "leave it out");
  if (request.plan && request.plan_file.empty())
    throw bad_input("--plan with a capture", "it names no plan",
                    "write --plan PLAN, or leave it out where plan.txt is beside the capture");
  if (request.captures.size() > 1)
    throw bad_input(request.captures[1].string(), "one capture is fitted at a time",
                    "write cosys-sim fit for each of them");
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
