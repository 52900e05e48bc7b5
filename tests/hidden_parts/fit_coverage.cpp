// How well a fit does on hidden parts: of each constant in how many of them it is told, how often
// the interval has the truth, and how far off the value is; and how long a fit takes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "hidden_part.hpp"
#include "hidden_recording.hpp"
#include "program.hpp"
#include "sim/counting/sample_quantile.hpp"
#include "sim/fit/fitted_module.hpp"

namespace hidden {
namespace {

constexpr const char* usage =
    R"(fit_coverage PLAN SEED N FIRST_LEVEL [--nearer DB] [--ambient W_PER_M2] [--broken K]

Fits N hidden parts by their recordings of a plan, of which the first step has FIRST_LEVEL mW/m2.
Prints a row a part and constant, separated by commas, then a table of all parts.
  --nearer   a second recording of each part, in light that is so much stronger, by about as much
             as the fit is told
  --ambient  another one, of the first light under a lamp
  --broken   1 to 5, a kind of parts that break the rule (hidden_parts says which), and in how many
             steps of the plan each part is heard to
)";

constexpr std::size_t few_steps = 3;  // fewer are no misfit

struct Request {
  sim::Plan plan;
  std::uint32_t parts = 0;
  double first_level = 0;
  std::optional<double> nearer_db{}, ambient_w_per_m2{};
  PartDraw draw;
};

/// Of one constant, over all parts.
struct Coverage {
  int told = 0, inside = 0;
  std::vector<double> errors;  // as a share, or of what may be 0 as it is
};

struct Outcome {
  std::map<std::string, Coverage> constants;
  std::vector<double> seconds;
  int parts = 0, misfits = 0;
  int unheard = 0;  // of the others: as good as nothing of the plan shows it
};

double truth_of(const HiddenPart& part, const std::string& key) {
  for (const ModuleNumber& number : module_numbers())
    if (key == number.key) return part.module.*number.member;
  return std::nan("");
}

void add(const HiddenPart& part, const sim::FittedModule& fitted, Outcome& outcome) {
  for (const sim::FittedNumber& number : fitted.numbers) {
    const double truth = truth_of(part, number.key);
    fmt::print("{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:d}\n", outcome.parts, number.key, truth,
               number.value, number.low, number.high, number.is_told);
    Coverage& coverage = outcome.constants[number.key];
    if (!number.is_told) continue;
    ++coverage.told;
    if (truth >= number.low && truth <= number.high) ++coverage.inside;
    coverage.errors.push_back(std::abs(truth > 0 ? number.value / truth - 1 : number.value));
  }
  for (const sim::FitMisfit& misfit : fitted.misfits)
    fmt::print("{},misfit,\"{}: {}\"\n", outcome.parts, misfit.what, misfit.by_how_much);
  ++outcome.parts;
  if (!fitted.misfits.empty()) ++outcome.misfits;
}

/// What is recorded of each part: lists as long as that of the parts.
std::vector<std::vector<sim::LightCapture>> captures_of(const Request& request,
                                                        std::vector<HiddenPart> parts) {
  std::vector<std::vector<sim::LightCapture>> captures(parts.size());
  const auto record = [&](double level, std::optional<double> said) {
    const auto recordings = recordings_of(request.plan, parts, level);
    for (std::size_t i = 0; i < parts.size(); ++i)
      captures[i].push_back({request.plan, recordings[i], said, parts.front().ambient_w_per_m2});
  };
  record(request.first_level, request.first_level);
  if (request.nearer_db)
    record(request.first_level * std::pow(10, *request.nearer_db / 20), std::nullopt);
  for (HiddenPart& part : parts) part.ambient_w_per_m2 = request.ambient_w_per_m2.value_or(0);
  if (request.ambient_w_per_m2) record(request.first_level, std::nullopt);
  return captures;
}

/// For how long the pin is low in each step, up to the next one's begin.
std::vector<double> low_of_steps(const sim::Plan& plan, const HiddenPart& part,
                                 const sim::PinRecording& recording) {
  std::vector<double> low;
  auto pulse = recording.pulses.begin();
  for (std::size_t s = 0; s < plan.steps.size(); ++s) {
    const double next_ms = s + 1 < plan.steps.size() ? plan.steps[s + 1].start_ms : HUGE_VAL;
    const double until_s = part.start_s + (1 + part.clock_error) * 1e-3 * next_ms;
    low.push_back(0);
    for (; pulse != recording.pulses.end() && pulse->start_s < until_s; ++pulse)
      low.back() += pulse->end_s - pulse->start_s;
  }
  return low;
}

/// In how many steps of the plan each part is heard to break the rule: low for a tenth longer or
/// shorter than if it followed it and were the same otherwise.
std::vector<std::size_t> steps_heard(const Request& request, std::vector<HiddenPart> parts,
                                     const std::vector<std::vector<sim::LightCapture>>& captures) {
  constexpr double other = 0.1;
  for (HiddenPart& part : parts) part.broken = Broken::nothing;
  const auto sound = recordings_of(request.plan, parts, request.first_level);
  std::vector<std::size_t> heard(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto low = low_of_steps(request.plan, parts[i], captures[i].front().recording);
    const auto sound_low = low_of_steps(request.plan, parts[i], sound[i]);
    for (std::size_t s = 0; s < low.size(); ++s)
      if (std::abs(low[s] - sound_low[s]) > other * std::max(low[s], sound_low[s])) ++heard[i];
  }
  return heard;
}

void fit(const Request& request, std::uint32_t first, Outcome& outcome) {
  std::vector<HiddenPart> parts;
  for (std::uint32_t k = first; k < std::min(request.parts, first + most_parts); ++k)
    parts.push_back(draw_part(request.draw, k, request.plan));
  const auto captures = captures_of(request, parts);
  const bool is_broken = request.draw.broken != Broken::nothing;
  const auto heard =
      is_broken ? steps_heard(request, parts, captures) : std::vector<std::size_t>(parts.size());
  channel::ModuleData like;
  like.centre_hz = request.draw.nominal_hz;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::clock_t began = std::clock();
    const sim::FittedModule fitted = sim::fit_module(captures[i], like);
    outcome.seconds.push_back(static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC);
    fmt::print("{},seconds,{:.1f}\n", outcome.parts, outcome.seconds.back());
    if (is_broken) fmt::print("{},steps heard to break the rule,{}\n", outcome.parts, heard[i]);
    if (fitted.misfits.empty() && heard[i] < few_steps) ++outcome.unheard;
    add(parts[i], fitted, outcome);
  }
}

void print(const Request& request, const Outcome& outcome) {
  fmt::print("\n{:24} {:>6} {:>8} {:>8} {:>8}\n", "constant", "told", "inside", "median", "90 %");
  for (const auto& [key, coverage] : outcome.constants)
    fmt::print("{:24} {:6} {:8} {:8.3f} {:8.3f}\n", key, coverage.told, coverage.inside,
               sim::sample_quantile(coverage.errors, 0.5),
               sim::sample_quantile(coverage.errors, 0.9));
  fmt::print(
      "of {} parts {} do not follow the rule; CPU of a fit: median {:.1f} s, most {:.1f} s\n",
      outcome.parts, outcome.misfits, sim::sample_quantile(outcome.seconds, 0.5),
      sim::sample_quantile(outcome.seconds, 1));
  if (request.draw.broken != Broken::nothing)
    fmt::print("of the others {} are heard to break it in fewer than {} steps\n", outcome.unheard,
               few_steps);
}

Request request_of(const std::vector<std::string>& words) {
  Request request{.plan = sim::read_plan(words.at(0)),
                  .parts = static_cast<std::uint32_t>(std::stoul(words.at(2))),
                  .first_level = std::stod(words.at(3)),
                  .draw = {.seed = std::stoull(words.at(1))}};
  request.draw.nominal_hz = nominal_of(request.plan);
  for (std::size_t i = 4; i < words.size(); i += 2) {
    const double number = std::stod(words.at(i + 1));
    if (words[i] == "--nearer")
      request.nearer_db = number;
    else if (words[i] == "--ambient")
      request.ambient_w_per_m2 = number;
    else if (words[i] == "--broken")
      request.draw.broken = static_cast<Broken>(std::lround(number));
    else
      throw std::invalid_argument(words[i]);
  }
  return request;
}

Outcome outcome_of(const Request& request) {
  Outcome outcome;
  fmt::print("part,constant,truth,value,low,high,is_told\n");
  for (std::uint32_t first = 0; first < request.parts; first += most_parts)
    fit(request, first, outcome);
  return outcome;
}

}  // namespace
}  // namespace hidden

int main(int argc, char** argv) {
  return hidden::program_of(argc, argv, hidden::usage, [](const std::vector<std::string>& words) {
    const hidden::Request request = hidden::request_of(words);
    hidden::print(request, hidden::outcome_of(request));
  });
}
