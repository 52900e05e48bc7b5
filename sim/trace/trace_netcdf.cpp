#include "sim/trace/trace_netcdf.hpp"

#include "dsp/spectrum.hpp"
#include "sim/result/netcdf.hpp"
#include "sim/result/netcdf_reader.hpp"

namespace sim {
namespace {

// Bins of 61 Hz at 1 MS/s: they tell apart the lines of the 300 Hz that 600 baud alternate with,
// and a trial of a second still gives more than a hundred periodograms to average.
constexpr std::size_t spectrum_segment = 1 << 14;

void write_taps(NetcdfFile& file, const TracedTrial& trial) {
  const std::vector<double> times = sample_times_s(trial);
  file.add_dimension({"time_s", "s", "time since the start of the trial"}, times);
  const auto wire = [&](const char* name, const char* long_name, const dsp::LogicTrace& trace) {
    const std::vector<std::uint8_t> levels = levels_at(trace, times);
    file.add_variable({name, "1", long_name}, {"time_s"}, std::span<const std::uint8_t>(levels));
  };
  wire("tx", "level of the wire that keys the LED, 0 is light", trial.tx);
  for (const Tap& tap : analogue_taps())
    file.add_variable({tap.name, tap.unit, tap.long_name}, {"time_s"},
                      std::span<const float>(trial.taps.*tap.samples));
  wire("rx", "level of the module's output, 0 is light", trial.rx);
}

void write_spectra(NetcdfFile& file, const TracedTrial& trial) {
  const auto of = [&](const std::vector<float>& samples) {
    return dsp::welch(samples, trial.sample_rate, spectrum_segment);
  };
  const dsp::Spectrum before = of(trial.taps.irradiance), behind = of(trial.taps.band_pass);
  const auto write = [&](const char* name, const char* what, const dsp::Spectrum& spectrum) {
    const std::string long_name =
        std::string("power spectral density of the ") + what + ", one-sided (Welch, Hann window)";
    file.add_variable({name, "mW2 m-4 Hz-1", long_name}, {"frequency_hz"},
                      std::span<const double>(spectrum.density));
  };
  file.add_dimension({"frequency_hz", "Hz", "frequency"}, before.frequency_hz);
  write("irradiance_spectrum", "irradiance", before);
  write("band_pass_spectrum", "output of the band-pass", behind);
}

void write_origin(NetcdfFile& file, const TracedTrial& trial) {
  const auto number = [&](const char* name, std::uint64_t value) {
    file.set_numbers(NetcdfFile::root, name, std::span<const std::uint64_t>(&value, 1));
  };
  file.set_user_text(NetcdfFile::root, "scenario_toml", trial.origin.scenario_toml);
  number("seed", trial.origin.seed);
  number("point", trial.origin.point);
  number("trial", trial.origin.trial);
  file.set_numbers(NetcdfFile::root, "sample_rate_hz",
                   std::span<const double>(&trial.sample_rate.value, 1));
}

}  // namespace

std::string trace_as_netcdf(const TracedTrial& trial) {
  NetcdfFile file(trace_type, trial.origin.program);
  write_taps(file, trial);
  write_spectra(file, trial);
  write_origin(file, trial);
  return file.image();
}

bool is_netcdf_trace(const std::filesystem::path& path) { return filetype_of(path) == trace_type; }

}  // namespace sim
