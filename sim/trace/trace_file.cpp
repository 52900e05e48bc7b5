#include "sim/trace/trace_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/picture/svg.hpp"
#include "sim/scenario/fidelity.hpp"
#include "sim/scenario/key_check.hpp"
#include "sim/text/existing_file.hpp"
#include "sim/text/new_file.hpp"
#include "sim/trace/pulse_write.hpp"
#include "sim/trace/raw_write.hpp"
#include "sim/trace/session_write.hpp"
#include "sim/trace/sigmf_write.hpp"
#include "sim/trace/trace_netcdf.hpp"
#include "sim/trace/trace_picture.hpp"
#include "sim/trace/vcd.hpp"
#include "sim/trace/wav_write.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

std::string to_vcd(const TracedTrial& trial) {
  std::ostringstream out;
  const std::vector<VcdWire> wires = {{"tx", &trial.tx}, {trial.pin, &trial.rx}};
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

bool is_own_vcd(const fs::path& path) {
  constexpr std::string_view head = "$version cosys-sim ";
  return beginning_of(path, head.size()) == head;
}

bool is_own_csv(const fs::path& path) {
  const std::string head = csv_header();
  return beginning_of(path, head.size()) == head;
}

bool is_own_pulses(const fs::path& path) {
  return beginning_of(path, pulses_head.size()) == pulses_head;
}

/// Nothing in a raw file says whose it is.
bool is_own_raw(const fs::path&) { return false; }

using Paths = std::vector<fs::path>;
using Contents = std::vector<std::string>;

Paths one_place(const fs::path& path) { return {path}; }

template <std::string (*Text)(const TracedTrial&)>
Contents one_file(const TracedTrial& trial) {
  return {Text(trial)};
}

/// Whether a format has them.
enum class Taps { never, if_wished, where_there, always };

struct Format {
  const char* ending;
  Paths (*places)(const fs::path&);          // its files, in the order in which they are placed
  Contents (*contents)(const TracedTrial&);  // of each
  OwnFiles own;                              // each of them, when it was written before
  Taps taps;
  bool names_wires = false;
};

constexpr const char* own_trace = "a trace of cosys-sim";

constexpr Format formats[] = {
    {".vcd", one_place, one_file<to_vcd>, {is_own_vcd, own_trace}, Taps::never, true},
    {".sr",
     one_place,
     one_file<trace_as_session>,
     {is_session_of_trace, own_trace},
     Taps::if_wished,
     true},
    {".ook", one_place, one_file<to_pulses>, {is_own_pulses, own_trace}, Taps::never},
    {".bin",
     one_place,
     one_file<trace_as_raw>,
     {is_own_raw, "known to be one of cosys-sim's"},
     Taps::never,
     false},
    {".svg", one_place, one_file<trace_as_picture>, {is_drawing, own_trace}, Taps::where_there},
    {".csv", one_place, one_file<to_csv>, {is_own_csv, own_trace}, Taps::always},
    {".h5", one_place, one_file<trace_as_netcdf>, {is_netcdf_trace, own_trace}, Taps::always},
    {".wav", one_place, one_file<trace_as_wav>, {is_wav_trace, own_trace}, Taps::always},
    {".sigmf-meta", sigmf_places, trace_as_sigmf, {is_sigmf_trace, own_trace}, Taps::always}};

const Format& format_of(const fs::path& path) {
  std::vector<const char*> known;
  for (const Format& format : formats) {
    if (path.extension() == format.ending) return format;
    known.push_back(format.ending);
  }
  throw bad_input("cannot trace into " + path.string(), "its ending names no format",
                  fmt::format("end the name in {}", fmt::join(known, " or ")));
}

bool has_taps(const Format& format, const TraceWishes& wishes) {
  return format.taps == Taps::if_wished ? wishes.taps : format.taps != Taps::never;
}

/// An option that changes nothing is a mistake of who typed it.
void refuse_useless_wishes(const fs::path& path, const TraceWishes& wishes) {
  const Format& format = format_of(path);
  const std::string name = path.filename().string();
  if (wishes.taps && format.taps != Taps::if_wished)
    throw bad_input("--taps",
                    name + (format.taps == Taps::always ? " has them anyway" : " has none"),
                    "leave it out, or end the name in .sr");
  const bool is_taken =
      wishes.pin == "tx" ||
      std::ranges::find(analogue_taps(), wishes.pin, &Tap::name) != analogue_taps().end();
  if (is_taken)
    throw bad_input("--pin " + wishes.pin, "another wire or tap is called so",
                    "choose another name");
  if (!wishes.pin.empty() && !format.names_wires)
    throw bad_input("--pin " + wishes.pin, "a wire of " + name + " gets no other name",
                    "leave it out, or end the name in .vcd or .sr");
  if (wishes.tail.value > 0 && has_taps(format, wishes))
    throw bad_input("--tail", name + " shows the trial alone, as its samples end there",
                    wishes.taps ? "leave out --tail or --taps"
                                : "leave it out, or end the name in .vcd, .sr, .ook or .bin");
}

TracedTrial as_wished(TracedTrial trial, const Format& format, const TraceWishes& wishes) {
  if (!has_taps(format, wishes)) trial.taps = {};
  if (!wishes.pin.empty()) trial.pin = wishes.pin;
  if (wishes.tail.value > 0) {
    const dsp::Seconds end = trial.tx.end() + wishes.tail;
    trial.tx.observe_until(end);
    trial.rx.observe_until(end);
  }
  return trial;
}

}  // namespace

void check_trace_path(const fs::path& path) {
  const Format& format = format_of(path);
  for (const fs::path& place : format.places(path)) check_place(place, format.own);
}

void check_traceable(const fs::path& path, const Scenario& scenario, const TraceWishes& wishes) {
  refuse_useless_wishes(path, wishes);
  const Format& format = format_of(path);
  if (!has_taps(format, wishes) || format.taps == Taps::where_there ||
      fidelity_of(scenario.simulation) == Fidelity::waveform)
    return;
  throw bad_input(
      "cannot trace into " + path.string(),
      "no samples are made at simulation.fidelity = \"" + scenario.simulation.fidelity + "\"",
      wishes.taps ? "leave out --taps" : "end the name in .vcd, which has the wires");
}

void write_trace(const fs::path& path, TracedTrial trial, const TraceWishes& wishes) {
  const Format& format = format_of(path);
  const Paths places = format.places(path);
  const Contents contents = format.contents(as_wished(std::move(trial), format, wishes));
  std::deque<NewFile> files;
  for (std::size_t i = 0; i < places.size(); ++i) files.emplace_back(places[i]).write(contents[i]);
  take_places(files);
}

}  // namespace sim
