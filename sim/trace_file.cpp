#include "sim/trace_file.hpp"

#include <fmt/format.h>

#include <sstream>
#include <string>
#include <vector>

#include "sim/failure.hpp"
#include "sim/keys.hpp"
#include "sim/new_file.hpp"
#include "sim/trial.hpp"
#include "sim/vcd.hpp"

namespace sim {
namespace {

std::string to_vcd(const TracedTrial& trial) {
  std::ostringstream out;
  const std::vector<VcdWire> wires = {{"tx", &trial.tx}, {"rx", &trial.rx}};
  write_vcd(out, wires, trial.tx.end());
  return out.str();
}

std::string to_csv(const TracedTrial& trial) {
  std::string text =
      "time_s,tx,irradiance_mw_per_m2,band_pass_mw_per_m2,threshold_mw_per_m2,integrator_samples,"
      "agc_gain,rx\n";
  const channel::Recording& taps = trial.taps;
  dsp::TraceReader tx(trial.tx), rx(trial.rx);
  for (std::size_t i = 0; i < taps.irradiance.size(); ++i) {
    const dsp::Seconds time(static_cast<double>(i + 1) / trial.sample_rate.value);
    fmt::format_to(std::back_inserter(text), "{:.9f},{:d},{:.6g},{:.6g},{:.6g},{},{:.6g},{:d}\n",
                   time.value, tx.level_at(time), taps.irradiance[i], taps.band_pass[i],
                   taps.threshold[i], taps.integrator[i], taps.agc_gain[i], rx.level_at(time));
  }
  return text;
}

struct Format {
  const char* ending;
  std::string (*text)(const TracedTrial&);
};

constexpr Format formats[] = {{".vcd", to_vcd}, {".csv", to_csv}};

const Format& format_of(const std::filesystem::path& path) {
  for (const Format& format : formats)
    if (path.extension() == format.ending) return format;
  std::string known;
  for (const Format& format : formats)
    known += (known.empty() ? "" : " or ") + std::string(format.ending);
  throw bad_input("cannot trace into " + path.string(), "its ending names no format",
                  "end the name in " + known);
}

}  // namespace

TracedTrial trace_trial(const Scenario& scenario, std::uint32_t trial) {
  const Link link = make_link(scenario);
  Transmission sent = transmit(link, trial);
  TracedTrial traced;
  traced.sample_rate = link.chain.sample_rate;
  traced.rx = channel::propagate_alone(link.chain, chain_input(link, trial, sent), &traced.taps);
  traced.tx = std::move(sent.line);
  return traced;
}

void check_trace_path(const std::filesystem::path& path) {
  format_of(path);
  NewFile probe(path);
}

void write_trace(const std::filesystem::path& path, const TracedTrial& trial) {
  const Format& format = format_of(path);
  NewFile file(path);
  file.write(format.text(trial));
  file.take_place();
}

}  // namespace sim
