#include "sim/trace/sigmf_write.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "protocol/uart.hpp"
#include "sim/failure.hpp"
#include "sim/text/escaped_text.hpp"
#include "sim/text/existing_file.hpp"
#include "sim/trace/baseband.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;  // the recorder comes first: files are recognised by it

static_assert(std::endian::native == std::endian::little, "samples are written as they are stored");

constexpr std::string_view own_head = "{\n  \"global\": {\n    \"core:recorder\": \"cosys-sim";

std::string sha512_of(const std::string& bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> hash{};
  unsigned size = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), hash.data(), &size, EVP_sha512(), nullptr) != 1)
    throw Failure(ExitCode::environment, "no SHA-512 of a trace (OpenSSL gave up) trace into .h5");
  std::string hex;
  for (unsigned i = 0; i < size; ++i) hex += fmt::format("{:02x}", hash[i]);
  return hex;
}

template <class Sample>
std::string bytes_of(const std::vector<Sample>& samples) {
  return {reinterpret_cast<const char*>(samples.data()), samples.size() * sizeof(Sample)};
}

/// What tells one of the two recordings from the other.
struct SigmfRecording {
  const char* datatype;
  const char* description;
  dsp::Hertz sample_rate, middle;  // middle 0: of real samples
};

Json global_of(const TracedTrial& trial, const SigmfRecording& recording, const std::string& data) {
  const TraceOrigin& origin = trial.origin;
  return {{"core:recorder",
           fmt::format("cosys-sim {} ({})", origin.program.version, origin.program.commit)},
          {"core:version", "1.2.5"},
          {"core:datatype", recording.datatype},
          {"core:sample_rate", recording.sample_rate.value},
          {"core:num_channels", 1},
          {"core:sha512", sha512_of(data)},
          {"core:description", recording.description},
          {"core:extensions", {{{"name", "cosys"}, {"version", "1.0.0"}, {"optional", true}}}},
          {"cosys:scenario_toml", origin.scenario_toml},
          {"cosys:seed", origin.seed},
          {"cosys:point", origin.point},
          {"cosys:trial", origin.trial}};
}

/// A box in the waterfall around each character that the device sends: OOK's main lobe.
Json annotations_of(const TracedTrial& trial, dsp::Hertz rate) {
  Json annotations = Json::array();
  const auto sample = [&](dsp::Seconds at) { return std::llround(dsp::cycles(at, rate)); };
  const dsp::Seconds length = protocol::bits_per_byte * dsp::period(trial.baud);
  for (const protocol::UartByte& sent : protocol::receive_mid_bit(trial.tx, trial.baud)) {
    const auto begin = sample(sent.start);
    annotations.push_back({{"core:sample_start", begin},
                           {"core:sample_count", sample(sent.start + length) - begin},
                           {"core:freq_lower_edge", (trial.carrier - trial.baud).value},
                           {"core:freq_upper_edge", (trial.carrier + trial.baud).value},
                           {"core:label", escaped(std::string(1, static_cast<char>(sent.value)))}});
  }
  return annotations;
}

std::string meta_of(const TracedTrial& trial, const SigmfRecording& recording,
                    const std::string& data) {
  Json capture = {{"core:sample_start", 0}};
  if (recording.middle.value > 0) capture["core:frequency"] = recording.middle.value;
  const Json meta = {{"global", global_of(trial, recording, data)},
                     {"captures", Json::array({capture})},
                     {"annotations", annotations_of(trial, recording.sample_rate)}};
  return meta.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

fs::path with_ending(const fs::path& path, const char* ending) {
  return fs::path(path).replace_extension(ending);
}

}  // namespace

std::vector<fs::path> sigmf_places(const fs::path& meta) {
  fs::path baseband = meta;
  baseband.replace_filename(meta.stem().string() + "-baseband.sigmf-meta");
  return {with_ending(meta, ".sigmf-data"), with_ending(baseband, ".sigmf-data"), meta, baseband};
}

std::vector<std::string> trace_as_sigmf(const TracedTrial& trial) {
  const std::vector<float>& light = trial.taps.irradiance;
  const Baseband baseband = baseband_of(light, trial.sample_rate, trial.carrier);
  std::string real = bytes_of(light), complex = bytes_of(baseband.samples);
  const SigmfRecording waveform{"rf32_le", "irradiance at the receiver in mW/m2, noise included",
                                trial.sample_rate, dsp::Hertz(0)};
  const SigmfRecording amplitude{"cf32_le",
                                 "complex amplitude in mW/m2 of the irradiance's carrier",
                                 baseband.sample_rate, trial.carrier};
  std::string meta = meta_of(trial, waveform, real);
  std::string baseband_meta = meta_of(trial, amplitude, complex);
  return {std::move(real), std::move(complex), std::move(meta), std::move(baseband_meta)};
}

bool is_sigmf_trace(const fs::path& place) {
  return beginning_of(with_ending(place, ".sigmf-meta"), own_head.size()) == own_head;
}

}  // namespace sim
