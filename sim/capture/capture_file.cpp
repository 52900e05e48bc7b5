#include "sim/capture/capture_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "sim/capture/capture_units.hpp"
#include "sim/capture/csv_capture.hpp"
#include "sim/capture/netcdf_capture.hpp"
#include "sim/capture/pulse_capture.hpp"
#include "sim/capture/raw_capture.hpp"
#include "sim/capture/session_capture.hpp"
#include "sim/capture/sigmf_capture.hpp"
#include "sim/capture/sigmf_meta.hpp"
#include "sim/capture/text_mark.hpp"
#include "sim/capture/vcd_capture.hpp"
#include "sim/capture/wav_capture.hpp"
#include "sim/failure.hpp"
#include "sim/text/escaped_text.hpp"
#include "sim/text/letters.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

/// Files that have a head, and are called .bin all the same.
struct OtherSamples {
  std::string_view beginning, what;
};

constexpr OtherSamples other_samples[] = {
    {"<SALEAE>", "a binary export of Logic 2"}, {"AG01", "a binary waveform of Keysight"},
    {"AG03", "a binary waveform of Keysight"},  {"AG10", "a binary waveform of Keysight"},
    {"RG01", "a binary waveform of Rigol"},     {"RG03", "a binary waveform of Rigol"}};

void refuse_other_samples(const fs::path& path, std::string_view beginning) {
  for (const OtherSamples& row : other_samples)
    if (beginning.starts_with(row.beginning))
      throw bad_input("cannot decode " + path.string(), "it is " + std::string(row.what),
                      "export it as CSV");
}

void as_vcd(const fs::path& path, const CaptureSettings& settings, Capture& capture) {
  capture.logic = open_vcd(*capture.in, path.string(), settings, capture.facts);
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
  refuse_other_samples(path, capture.in->beginning());
  if (const auto bytes = bytes_it_looks_like(capture.in->beginning());
      bytes && !settings.sample_bytes)
    capture.facts.doubt = fmt::format(
        "its bytes repeat every {0} (it may have {0} a sample) say --sample-bytes {0}, or 1",
        *bytes);
  capture.logic =
      open_raw(*capture.in, path.string(),
               {settings.sample_rate, static_cast<std::size_t>(settings.sample_bytes.value_or(1))});
  capture.facts.time = samples_text(*settings.sample_rate);
}

void as_wav(const fs::path& path, const CaptureSettings& settings, Capture& capture) {
  open_wav(path, settings, capture);
}

void as_sigmf(const fs::path& path, const CaptureSettings& settings, Capture& capture) {
  open_sigmf(path, settings, capture);
}

void as_sigmf_data(const fs::path& path, const CaptureSettings& settings, Capture& capture) {
  as_sigmf(sigmf_beside(path, ".sigmf-meta"), settings, capture);
}

void as_netcdf(const fs::path& path, const CaptureSettings& settings, Capture& capture) {
  open_netcdf(path, settings, capture);
}

/// What a format is read from: Capture::in, before whose text a mark may stand, or the path, which
/// may be a pipe or must be a file.
enum class From { text, bytes, path, file };

struct Format {
  std::string_view name;       // also the file's ending, behind a dot
  std::string_view beginning;  // of every such file; empty: none is sure
  void (*open)(const fs::path&, const CaptureSettings&, Capture&);
  From from = From::file;
  bool takes_rate = true;
};

constexpr Format formats[] = {{"vcd", "$", as_vcd, From::text, false},
                              {"sr", "PK\x03\x04", as_session},
                              {"ook", ";pulse data", as_pulses, From::text, false},
                              {"wav", "RIFF", as_wav, From::path, false},
                              {"sigmf-meta", "", as_sigmf},
                              {"sigmf-data", "", as_sigmf_data},
                              {"csv", "", as_csv, From::text},
                              {"h5", "\x89HDF", as_netcdf},
                              {"bin", "", as_raw, From::bytes}};

/// In small letters, as file systems of instruments write capitals alone.
std::string ending_of(const fs::path& path) {
  const std::string ending = in_lower_case(path.extension().string());
  return ending.empty() ? "" : ending.substr(1);
}

/// What is read by itself must be a file; a .wav may be a pipe of which nothing was read to tell
/// its format.
void refuse_pipe(const Format& format, const fs::path& path, const CaptureSettings& settings) {
  std::error_code ignored;
  const bool is_pipe = fs::is_fifo(path, ignored);
  const bool is_told = !settings.format.empty() || ending_of(path) == format.name;
  if (!is_pipe || format.from == From::text || format.from == From::bytes) return;
  if (format.from == From::file)
    throw bad_input("cannot decode " + path.string(),
                    fmt::format("a .{} cannot be read from a pipe", format.name), "give a file");
  if (!is_told)
    throw bad_input("cannot decode " + path.string(), "its beginning was read to tell its format",
                    fmt::format("say --format {}", format.name));
}

/// Of texts that may be tables.
constexpr std::string_view table_endings[] = {"txt", "tsv", "dat", "asc", "lvm"};

/// An option that says what the format says itself must not be passed over in silence, unless it
/// is meant for other files.
void refuse_useless_options(const Format& format, const std::string& file,
                            const CaptureSettings& settings) {
  if (settings.is_one_of_many) return;
  const bool is_table = format.open == as_csv;
  const std::pair<const char*, bool> useless[] = {
      {"--sample-bytes", settings.sample_bytes && format.open != as_raw},
      {"--sample-rate", settings.sample_rate && !format.takes_rate},
      {"--time-unit", settings.tick && !is_table && format.open != as_vcd},
      {"--skip-rows", settings.skip_rows > 0 && !is_table}};
  for (const auto& [option, is_useless] : useless)
    if (is_useless)
      throw bad_input(fmt::format("{} is not for {}", option, file),
                      "its format says that itself, or has none", "leave it out");
}

/// What is near a format and not read.
struct OtherFile {
  std::string_view ending, why, suggestion;
};

constexpr OtherFile other_files[] = {
    {"sigmf", "it is a SigMF archive", "unpack it with tar -xf, and give the .sigmf-meta in it"},
    {"sigmf-collection", "it is a SigMF collection", "give a .sigmf-meta that it names"}};

void refuse_other(const fs::path& path, std::string_view ending) {
  const auto* row = std::ranges::find(other_files, ending, &OtherFile::ending);
  if (row != std::end(other_files))
    throw bad_input("cannot decode " + path.string(), std::string(row->why),
                    std::string(row->suggestion));
}

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
  const std::string ending = ending_of(path);
  refuse_other(path, ending);
  if (const Format* by_name = named(ending)) return *by_name;
  const std::string_view beginning = capture.in->beginning();
  const std::size_t mark = mark_bytes(beginning, path.string());
  if (const Format* by_content = recognised(beginning.substr(mark))) return *by_content;
  if (std::ranges::find(table_endings, ending) != std::end(table_endings)) return *named("csv");
  if (beginning.empty())
    throw bad_input("cannot decode " + path.string(), "nothing is in it",
                    "of a pipe, start the writer first");
  throw bad_input(
      "cannot decode " + path.string(),
      "neither its ending nor its first bytes name a capture format",
      fmt::format("give a .{} file, or say --format", fmt::join(capture_format_names(), " or .")));
}

void skip_mark(InputStream& in, const fs::path& path) {
  for (std::size_t n = mark_bytes(in.beginning(), path.string()); n > 0; --n) in.rdbuf()->sbumpc();
}

void open_as(const Format& format, const fs::path& path, const CaptureSettings& settings,
             Capture& capture) {
  if (format.from == From::text) skip_mark(*capture.in, path);
  format.open(path, settings, capture);
}

/// Whether a line is found that nothing speaks against.
bool is_settled(std::span<const ChannelSurvey> surveys) {
  const ChannelChoice choice = choice_of_channel(surveys);
  const ChannelSurvey& taken = surveys[choice.channel];
  return !choice.rival && makes_sense(taken.facts.reading) &&
         dead_receiver(surveys, choice.channel) == nullptr;
}

/// Of a long file more than its beginning is looked at where no line is in that: a clock may fill
/// it alone.
WireSurveys surveys_of_file(const SurveyedCapture& beginning, const Format& format,
                            const fs::path& path, const CaptureSettings& settings) {
  WireSurveys surveys{beginning.surveys(settings.hints), beginning.is_whole()};
  std::error_code ignored;
  if (surveys.is_whole || is_settled(surveys.wires) || !fs::is_regular_file(path, ignored))
    return surveys;
  Capture again;
  again.in = std::make_unique<InputStream>(path, "capture");
  open_as(format, path, settings, again);
  return surveys_of(*again.logic, settings.hints);
}

/// Looks at the wires, and takes one.
void choose_wire(const Format& format, const fs::path& path, const CaptureSettings& settings,
                 Capture& capture) {
  const std::string file = path.string();
  if (capture.logic->wires().empty())
    throw bad_input(file + " holds no one-bit wire", "there is nothing to decode",
                    "give a capture of the receiver's output");
  auto surveyed = std::make_unique<SurveyedCapture>(std::move(capture.logic));
  CaptureFacts& facts = capture.facts;
  facts.is_whole = surveyed->is_whole();
  if (settings.wire.empty()) {
    const WireSurveys surveys = surveys_of_file(*surveyed, format, path, settings);
    facts.is_whole = surveys.is_whole;
    capture.wire = take_choice(surveys.wires, facts);
  } else {
    capture.wire = named_channel(surveyed->wires(), settings.wire, file);
    const std::vector<std::uint64_t> edges = surveyed->edges();
    for (std::size_t i = 0; i < edges.size(); ++i)
      facts.channels.push_back({surveyed->wires()[i], edges[i]});
  }
  facts.taken = capture.wire;
  capture.logic = std::move(surveyed);
}

}  // namespace

std::size_t take_choice(std::span<const ChannelSurvey> surveys, CaptureFacts& facts) {
  const ChannelChoice choice = choice_of_channel(surveys);
  for (const ChannelSurvey& survey : surveys)
    facts.channels.push_back({survey.name, survey.n_edges});
  facts.rival = choice.rival;
  const auto passed_over = std::ranges::count_if(surveys, [](const ChannelSurvey& survey) {
    return survey.n_edges > 0 && !survey.is_surveyed;
  });
  if (passed_over > 0)
    facts.assumed.push_back(
        fmt::format("no line on the other {} channels with edges", passed_over));
  if (const ChannelSurvey* dead = dead_receiver(surveys, choice.channel); dead != nullptr)
    facts.doubt = fmt::format(
        "nothing is on {}, so {} was read (nothing was heard, or it is not "
        "connected) say --channel",
        escaped_name(dead->name), escaped_name(surveys[choice.channel].name));
  return choice.channel;
}

Capture open_capture(const fs::path& named, const CaptureSettings& settings) {
  const fs::path path = named == "-" ? "/dev/stdin" : named;
  Capture capture;
  capture.in = std::make_unique<InputStream>(path, "capture");
  const Format& format = format_of(path, settings, capture);
  refuse_useless_options(format, path.string(), settings);
  refuse_pipe(format, path, settings);
  open_as(format, path, settings, capture);
  capture.facts.format = format.name;
  if (!capture.facts.taken) choose_wire(format, path, settings, capture);
  return capture;
}

std::vector<std::string> capture_format_names() {
  std::vector<std::string> names;
  for (const Format& format : formats) names.emplace_back(format.name);
  return names;
}

bool has_capture_ending(const fs::path& path) {
  const std::string ending = ending_of(path);
  return ending != "sigmf-data" && named(ending) != nullptr;
}

}  // namespace sim
