// Writes hidden parts: what a logic analyser records of modules' outputs while a plan is played to
// them, and, in a file of its own, what they are.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "hidden_part.hpp"
#include "hidden_recording.hpp"
#include "program.hpp"

namespace hidden {
namespace {

constexpr const char* usage =
    R"(hidden_parts PLAN SEED N FOLDER [--first-level MW_PER_M2] [--like F0_HZ SHARE]
             [--ambient W_PER_M2] [--broken K]

Writes FOLDER/k.csv, what a logic analyser of 1 MS/s records, and FOLDER/k.truth, for k = 0 to N-1.
  --first-level  irradiance of the plan's first step (300)
  --like         centres are F0_HZ (1 +- SHARE) (the usual one nearest to the plan's carrier, 0.03)
  --ambient      of a lamp on all parts (0)
  --broken       the slow AGC breaks the rule; all else is as without.
                 1: attack doubles once the gain has fallen by 20 dB
                 2: release is 3 times as fast in its first 10 ms as after them
                 3: gain falls for short bursts too, a fifth as fast as for long ones
                 4: of bursts beyond 300 cycles half the duty is tolerated
                 5: gain falls linearly in amplitude, by 20 dB in the same time
)";

struct Request {
  sim::Plan plan;
  std::uint32_t parts = 0;
  std::filesystem::path folder;
  double first_level_mw_per_m2 = 300;
  double ambient_w_per_m2 = 0;
  PartDraw draw;
};

Broken broken_of(const std::string& word) {
  if (word.size() != 1 || word < "1" || word > "5") throw std::invalid_argument(word);
  return static_cast<Broken>(std::stoi(word));
}

/// Takes an option and returns how many words it has.
std::size_t take_option(const std::vector<std::string>& words, std::size_t at, Request& request) {
  const auto number = [&](std::size_t i) { return std::stod(words.at(at + i)); };
  if (words[at] == "--first-level") {
    request.first_level_mw_per_m2 = number(1);
    return 2;
  }
  if (words[at] == "--ambient") {
    request.ambient_w_per_m2 = number(1);
    return 2;
  }
  if (words[at] == "--like") {
    request.draw.nominal_hz = number(1);
    request.draw.centre_share = number(2);
    return 3;
  }
  if (words[at] == "--broken") {
    request.draw.broken = broken_of(words.at(at + 1));
    return 2;
  }
  throw std::invalid_argument(words[at]);
}

Request request_of(const std::vector<std::string>& words) {
  Request request{.plan = sim::read_plan(words.at(0)),
                  .parts = static_cast<std::uint32_t>(std::stoul(words.at(2))),
                  .folder = words.at(3),
                  .draw = {.seed = std::stoull(words.at(1))}};
  request.draw.nominal_hz = nominal_of(request.plan);
  for (std::size_t i = 4; i < words.size();) i += take_option(words, i, request);
  return request;
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

std::string csv_of(const sim::PinRecording& recording) {
  const auto row = [](double s, int pin) { return fmt::format("{:.6f},{}\n", s, pin); };
  std::string text = "time_s,pin\n" + row(recording.begin_s, 1);
  for (const sim::PinPulse& pulse : recording.pulses)
    text += row(pulse.start_s, 0) + row(pulse.end_s, 1);
  return text + row(recording.end_s, 1);
}

std::string truth_of(const HiddenPart& part, double first_level_mw_per_m2) {
  std::string text;
  for (const ModuleNumber& number : module_numbers())
    text += fmt::format("{} {}\n", number.key, part.module.*number.member);
  if (part.broken != Broken::nothing)
    text += fmt::format("broken {}\n", static_cast<int>(part.broken));
  text += fmt::format("clock_error {}\nstart_s {}\n", part.clock_error, part.start_s);
  text += fmt::format("ambient_w_per_m2 {}\n", part.ambient_w_per_m2);
  text += fmt::format("said_first_level_mw_per_m2 {}\n", first_level_mw_per_m2);
  text += fmt::format("first_level_mw_per_m2 {}\n", first_level_mw_per_m2 * level_factor(part, 0));
  for (const auto& [key, factor] : part.level_factor)
    text += fmt::format("level_factor[{:.2f}] {}\n", static_cast<double>(key) / 100, factor);
  return text;
}

void write_parts(const Request& request) {
  std::filesystem::create_directories(request.folder);
  for (std::uint32_t first = 0; first < request.parts; first += most_parts) {
    std::vector<HiddenPart> parts;
    for (std::uint32_t k = first; k < std::min(request.parts, first + most_parts); ++k)
      parts.push_back(draw_part(request.draw, k, request.plan));
    for (HiddenPart& part : parts) part.ambient_w_per_m2 = request.ambient_w_per_m2;
    const auto recordings = recordings_of(request.plan, parts, request.first_level_mw_per_m2);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const std::string name = std::to_string(first + i);
      write(request.folder / (name + ".csv"), csv_of(recordings[i]));
      write(request.folder / (name + ".truth"), truth_of(parts[i], request.first_level_mw_per_m2));
    }
  }
}

}  // namespace
}  // namespace hidden

int main(int argc, char** argv) {
  return hidden::program_of(argc, argv, hidden::usage, [](const std::vector<std::string>& words) {
    hidden::write_parts(hidden::request_of(words));
  });
}
