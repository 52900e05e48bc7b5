#include "sim/fit/captured_lines.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "sim/capture/carrier_demodulator.hpp"
#include "sim/capture/sampled_line.hpp"
#include "sim/failure.hpp"
#include "sim/text/escaped_text.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_lines = 16;      // are read of a capture
constexpr double coarsest_sample_s = 1e-4;  // a pulse of a module lasts that at least

/// All changes of a line.
void read_changes(EdgeSource& source, const ReadingListener& reached, CapturedLine& line) {
  constexpr std::size_t told = 1024;  // of so many the last: they may be far apart
  line.initial = source.initial();
  while (const auto edge = source.next()) {
    line.edges_s.push_back(edge->value);
    if (line.edges_s.size() % told == 0) reached(*edge);
  }
  line.resolution_s = source.resolution().value;
  line.end_s = source.known_until().value;
  if (!line.edges_s.empty()) line.end_s = std::max(line.end_s, line.edges_s.back());
}

CapturedLine line_of(const Capture& capture, const ReadingListener& reached) {
  CapturedLine line{.name = capture.facts.channels[*capture.facts.taken].name, .edges_s = {}};
  if (capture.logic) {
    WireEdges wire(*capture.logic, capture.wire);
    CarrierDemodulator keyed(wire, std::nullopt);
    line.carrier_hz = keyed.carrier().value;
    read_changes(keyed, reached, line);
  } else {
    SampledLine sampled(*capture.samples, {});
    line.carrier_hz = sampled.carrier().value;
    line.is_sampled = true;
    read_changes(sampled, reached, line);
  }
  return line;
}

/// Of a capture's channels those that may have edges.
std::vector<std::string> live_channels(const CaptureFacts& facts) {
  std::vector<std::string> names;
  for (const CaptureFacts::Channel& channel : facts.channels)
    if (channel.edges.value_or(1) > 0) names.push_back(channel.name);
  return names;
}

void refuse_reading_again(const fs::path& path, const std::vector<std::string>& names) {
  const std::string suggestion = "say --wire and --plan";
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored))
    throw bad_input(path.string(), "it has several wires, and a pipe is read once", suggestion);
  if (names.size() > most_lines)
    throw bad_input(
        path.string(),
        fmt::format("{} of its wires have edges, which are too many to try", names.size()),
        suggestion);
}

std::string names_of_lines(const std::vector<const CapturedLine*>& lines) {
  std::vector<std::string> names;
  for (const CapturedLine* line : lines) names.push_back(escaped_name(line->name));
  return fmt::format("{}", fmt::join(names, ", "));
}

template <class Fits>
std::vector<const CapturedLine*> lines_that(const std::vector<CapturedLine>& lines,
                                            const Fits& fits) {
  std::vector<const CapturedLine*> some;
  for (const CapturedLine& line : lines)
    if (fits(line)) some.push_back(&line);
  return some;
}

/// The only one of the lists that has one alone, the first list first; else null.
const CapturedLine* only_one(std::initializer_list<std::vector<const CapturedLine*>> lists) {
  for (const auto& list : lists)
    if (list.size() == 1) return list.front();
  return nullptr;
}

void refuse_what_is_no_output(const CapturedLine& line, const std::string& file) {
  const std::string at = fmt::format("{} of {}", escaped_name(line.name), file);
  if (line.carrier_hz > 0)
    throw bad_input(at,
                    fmt::format("it has a carrier of {:.4g} kHz, which a module's output has not",
                                line.carrier_hz / 1e3),
                    "say --wire, the module's output");
  if (line.resolution_s > coarsest_sample_s)
    throw bad_input(at,
                    fmt::format("a sample each {:.3g} ms is too few for a module's pulses",
                                line.resolution_s * 1e3),
                    "record at 100 kS/s or more");
}

}  // namespace

bool CapturedLine::idles_high() const {
  double high_s = 0, last_s = 0;
  bool level = initial;
  for (const double edge_s : edges_s) {
    if (level) high_s += edge_s - last_s;
    last_s = edge_s;
    level = !level;
  }
  if (level) high_s += end_s - last_s;
  return 2 * high_s >= end_s;
}

std::vector<CapturedLine> read_lines(const fs::path& path, const CaptureSettings& settings,
                                     const ReadingListener& reached) {
  const Capture first = open_capture(path, settings);
  const std::vector<std::string> names = live_channels(first.facts);
  if (!settings.wire.empty() || names.size() < 2) return {line_of(first, reached)};
  refuse_reading_again(path, names);
  std::vector<CapturedLine> lines;
  for (const std::string& name : names) {
    CaptureSettings of_one = settings;
    of_one.wire = name;
    lines.push_back(line_of(open_capture(path, of_one), reached));
  }
  return lines;
}

const CapturedLine& module_line(const std::vector<CapturedLine>& lines, const WantedLines& wanted,
                                const std::string& file) {
  const auto named = lines_that(lines, [&](const auto& l) { return l.name == wanted.module; });
  const auto others = lines_that(lines, [&](const auto& l) { return l.name != wanted.drive; });
  const auto rx = lines_that(lines, [](const auto& l) { return is_called_rx(l.name); });
  const auto idle = lines_that(lines, [&](const CapturedLine& l) {
    return l.name != wanted.drive && l.carrier_hz == 0 && l.idles_high();
  });
  if (const CapturedLine* only = only_one({named, others, rx, idle})) return *only;
  throw bad_input(fmt::format("which wire of {} is the module's output", file),
                  idle.empty() ? "none idles high: " + names_of_lines(others)
                               : "it may be " + names_of_lines(idle),
                  "say --wire");
}

std::string drive_line(const std::vector<CapturedLine>& lines, const WantedLines& wanted,
                       const CapturedLine& module, const std::string& file) {
  if (wanted.drive == module.name)
    throw bad_input("--drive " + wanted.drive, "it is the module's output",
                    "name the wire that drives the LED");
  if (!wanted.drive.empty()) return wanted.drive;
  const auto others =
      lines_that(lines, [&](const CapturedLine& l) { return l.name != module.name; });
  if (others.size() == 1) return others.front()->name;
  throw bad_input(
      "no plan of " + file,
      "no plan.txt is beside it, and several wires may drive the LED: " + names_of_lines(others),
      "say --plan PLAN, or --drive");
}

PinRecording pin_recording(const CapturedLine& module, std::optional<bool> inverted,
                           const std::string& file) {
  refuse_what_is_no_output(module, file);
  const bool reports_high = inverted.value_or(!module.idles_high());
  PinRecording recording{.pulses = {}, .end_s = module.end_s, .resolution_s = module.resolution_s};
  bool reports = module.initial == reports_high;
  double start_s = 0;
  for (const double edge_s : module.edges_s) {
    if (reports) recording.pulses.push_back({start_s, edge_s});
    start_s = edge_s;
    reports = !reports;
  }
  if (reports) recording.pulses.push_back({start_s, module.end_s});
  if (module.edges_s.empty())
    throw bad_input(fmt::format("{} of {}", escaped_name(module.name), file),
                    "it never changes: the module reported nothing, or is not connected",
                    "look at wires and supply, or say --wire");
  return recording;
}

}  // namespace sim
