#include "sim/capture/capture_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "sim/capture/csv_capture.hpp"
#include "sim/capture/netcdf_capture.hpp"
#include "sim/capture/pulse_capture.hpp"
#include "sim/capture/raw_capture.hpp"
#include "sim/capture/session_capture.hpp"
#include "sim/capture/sigmf_capture.hpp"
#include "sim/capture/vcd_capture.hpp"
#include "sim/capture/wav_capture.hpp"
#include "sim/failure.hpp"
#include "sim/text/spelling.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

void as_vcd(const fs::path& path, const CaptureSettings& settings, Capture& capture) {
  capture.logic = open_vcd(*capture.in, path.string(), settings);
}

void as_csv(const fs::path& path, const CaptureSettings& settings, Capture& capture) {
  open_csv(path.string(), settings, capture);
}

void as_pulses(const fs::path& path, const CaptureSettings&, Capture& capture) {
  capture.logic = open_pulses(*capture.in, path.string());
}

void as_session(const fs::path& path, const CaptureSettings& settings, Capture& capture) {
  open_session(path, settings, capture);
}

void as_raw(const fs::path& path, const CaptureSettings& settings, Capture& capture) {
  capture.logic =
      open_raw(*capture.in, path.string(),
               {settings.sample_rate, static_cast<std::size_t>(settings.sample_bytes.value_or(1))});
}

void as_wav(const fs::path& path, const CaptureSettings& settings, Capture& capture) {
  capture.samples = open_wav(path, settings.wire);
}

void as_sigmf(const fs::path& path, const CaptureSettings& settings, Capture& capture) {
  capture.samples = open_sigmf(path, settings);
}

void as_netcdf(const fs::path& path, const CaptureSettings& settings, Capture& capture) {
  open_netcdf(path, settings, capture);
}

struct Format {
  std::string_view name;       // also the file's ending, behind a dot
  std::string_view beginning;  // of every such file; empty: none is sure
  void (*open)(const fs::path&, const CaptureSettings&, Capture&);
};

constexpr Format formats[] = {{"vcd", "$", as_vcd},
                              {"sr", "PK\x03\x04", as_session},
                              {"ook", ";pulse data", as_pulses},
                              {"wav", "RIFF", as_wav},
                              {"sigmf-meta", "", as_sigmf},
                              {"csv", "", as_csv},
                              {"h5", "\x89HDF", as_netcdf},
                              {"bin", "", as_raw}};

const Format* named(std::string_view name) {
  const auto* row = std::ranges::find(formats, name, &Format::name);
  return row == std::end(formats) ? nullptr : row;
}

const Format* recognised(std::string_view beginning) {
  const auto* row = std::ranges::find_if(formats, [&](const Format& format) {
    return !format.beginning.empty() && beginning.starts_with(format.beginning);
  });
  return row == std::end(formats) ? nullptr : row;
}

const Format& format_of(const fs::path& path, const CaptureSettings& settings, Capture& capture) {
  if (!settings.format.empty()) return *named(settings.format);
  const std::string ending = path.extension().string();
  if (const Format* by_name = ending.empty() ? nullptr : named(ending.substr(1))) return *by_name;
  if (const Format* by_content = recognised(capture.in->beginning())) return *by_content;
  if (capture.in->beginning().empty())
    throw bad_input("cannot decode " + path.string(), "nothing is in it",
                    "of a pipe, start the writer first");
  throw bad_input(
      "cannot decode " + path.string(),
      "neither its ending nor its first bytes name a capture format",
      fmt::format("give a .{} file, or say --format", fmt::join(capture_format_names(), " or .")));
}

}  // namespace

Capture open_capture(const fs::path& named, const CaptureSettings& settings) {
  const fs::path path = named == "-" ? "/dev/stdin" : named;
  Capture capture;
  capture.in = std::make_unique<InputStream>(path, "capture");
  const Format& format = format_of(path, settings, capture);
  if (settings.sample_bytes && format.open != as_raw)
    throw bad_input("--sample-bytes is not for " + path.string(), "its format says them itself",
                    "leave it out");
  format.open(path, settings, capture);
  return capture;
}

std::size_t wanted_wire(const std::vector<std::string>& wires, const std::string& wanted,
                        const std::string& file) {
  const auto found = std::ranges::find(wires, wanted.empty() ? "rx" : wanted);
  if (found != wires.end()) return static_cast<std::size_t>(found - wires.begin());
  if (wires.empty())
    throw bad_input(file + " holds no one-bit wire", "there is nothing to decode",
                    "give a capture of the receiver's output");
  if (wanted.empty()) return 0;
  throw bad_input(fmt::format("--wire {} is not in {}", wanted, file),
                  "the capture has no such wire", "use " + nearest(wanted, wires));
}

std::vector<std::string> capture_format_names() {
  std::vector<std::string> names;
  for (const Format& format : formats) names.emplace_back(format.name);
  return names;
}

}  // namespace sim
