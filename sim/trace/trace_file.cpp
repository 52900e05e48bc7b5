#include "sim/trace/trace_file.hpp"

#include <fmt/format.h>

#include <sstream>
#include <string_view>
#include <vector>

#include "sim/scenario/fidelity.hpp"
#include "sim/scenario/key_check.hpp"
#include "sim/text/existing_file.hpp"
#include "sim/text/new_file.hpp"
#include "sim/trace/pulse_write.hpp"
#include "sim/trace/session_write.hpp"
#include "sim/trace/trace_netcdf.hpp"
#include "sim/trace/vcd.hpp"

namespace sim {
namespace {

std::string to_vcd(const TracedTrial& trial) {
  std::ostringstream out;
  const std::vector<VcdWire> wires = {{"tx", &trial.tx}, {"rx", &trial.rx}};
  write_vcd(out, wires, trial.tx.end());
  return out.str();
}

std::string csv_header() {
  std::string header = "time_s,tx";
  for (const Tap& tap : analogue_taps()) header += "," + std::string(tap.name);
  return header + ",rx\n";
}

std::string to_csv(const TracedTrial& trial) {
  const std::vector<double> times = sample_times_s(trial);
  const std::vector<std::uint8_t> tx = levels_at(trial.tx, times), rx = levels_at(trial.rx, times);
  std::string text = csv_header();
  for (std::size_t i = 0; i < times.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "{:.9f},{}", times[i], tx[i]);
    for (const Tap& tap : analogue_taps())
      fmt::format_to(std::back_inserter(text), ",{:.6g}", (trial.taps.*tap.samples)[i]);
    fmt::format_to(std::back_inserter(text), ",{}\n", rx[i]);
  }
  return text;
}

std::string to_pulses(const TracedTrial& trial) {
  std::ostringstream out;
  write_pulses(out, trial.rx);
  return out.str();
}

bool is_own_vcd(const std::filesystem::path& path) {
  constexpr std::string_view head = "$version cosys-sim ";
  return beginning_of(path, head.size()) == head;
}

bool is_own_csv(const std::filesystem::path& path) {
  const std::string head = csv_header();
  return beginning_of(path, head.size()) == head;
}

bool is_own_pulses(const std::filesystem::path& path) {
  return beginning_of(path, pulses_head.size()) == pulses_head;
}

struct Format {
  const char* ending;
  std::string (*text)(const TracedTrial&);
  bool (*is_own)(const std::filesystem::path&);  // whether a file was written by `text`
  bool needs_taps;
};

constexpr Format formats[] = {{".vcd", to_vcd, is_own_vcd, false},
                              {".sr", trace_as_session, is_session_of_trace, false},
                              {".ook", to_pulses, is_own_pulses, false},
                              {".csv", to_csv, is_own_csv, true},
                              {".h5", trace_as_netcdf, is_netcdf_trace, true}};

const Format& format_of(const std::filesystem::path& path) {
  std::vector<const char*> known;
  for (const Format& format : formats) {
    if (path.extension() == format.ending) return format;
    known.push_back(format.ending);
  }
  throw bad_input("cannot trace into " + path.string(), "its ending names no format",
                  fmt::format("end the name in {}", fmt::join(known, " or ")));
}

}  // namespace

void check_trace_path(const std::filesystem::path& path) {
  refuse_to_lose(path, format_of(path).is_own, "a trace of cosys-sim");
  const NewFile probe(path);
}

void check_traceable(const std::filesystem::path& path, const Scenario& scenario) {
  if (!format_of(path).needs_taps || fidelity_of(scenario.simulation) == Fidelity::waveform) return;
  throw bad_input(
      "cannot trace into " + path.string(),
      "no samples are made at simulation.fidelity = \"" + scenario.simulation.fidelity + "\"",
      "end the name in .vcd, which has the wires");
}

void write_trace(const std::filesystem::path& path, const TracedTrial& trial) {
  const std::string text = format_of(path).text(trial);
  NewFile file(path);
  file.write(text);
  file.take_place();
}

}  // namespace sim
