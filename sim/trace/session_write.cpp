#include "sim/trace/session_write.hpp"

#include <fmt/format.h>
#include <zip.h>

#include <deque>

#include "sim/failure.hpp"
#include "sim/text/existing_file.hpp"
#include "sim/trace/raw_write.hpp"

namespace sim {
namespace {

constexpr std::string_view first_member = "cosys-sim";  // the scenario; sigrok passes it over

/// A zip that is built in memory.
class ZipImage {
 public:
  ZipImage() {
    source_ = zip_source_buffer_create(nullptr, 0, 0, nullptr);
    if (source_ != nullptr) zip_source_keep(source_);
    zip_ = source_ == nullptr ? nullptr : zip_open_from_source(source_, ZIP_TRUNCATE, nullptr);
    if (zip_ == nullptr) fail();
  }
  ~ZipImage() {
    if (zip_ != nullptr) zip_discard(zip_);
    zip_source_free(source_);
  }
  ZipImage(const ZipImage&) = delete;
  ZipImage& operator=(const ZipImage&) = delete;

  void add(const std::string& name, std::string content) {
    const std::string& kept = contents_.emplace_back(std::move(content));
    zip_source_t* source = zip_source_buffer(zip_, kept.data(), kept.size(), 0);
    const zip_int64_t index = zip_file_add(zip_, name.c_str(), source, 0);
    constexpr std::time_t first_day_of_zip = 315532800;  // 1980, whenever it is made
    if (index < 0) fail();
    zip_file_set_mtime(zip_, static_cast<zip_uint64_t>(index), first_day_of_zip, 0);
  }

  std::string bytes() {
    if (zip_close(zip_) != 0) fail();
    zip_ = nullptr;
    zip_stat_t facts;
    if (zip_source_open(source_) != 0 || zip_source_stat(source_, &facts) != 0) fail();
    std::string image(facts.size, '\0');
    if (zip_source_read(source_, image.data(), image.size()) !=
        static_cast<zip_int64_t>(image.size()))
      fail();
    zip_source_close(source_);
    return image;
  }

 private:
  [[noreturn]] static void fail() {
    throw Failure(ExitCode::environment,
                  "the session cannot be packed (not enough memory) trace into .vcd");
  }

  std::deque<std::string> contents_;  // until the zip is closed
  zip_source_t* source_ = nullptr;
  zip_t* zip_ = nullptr;
};

std::string metadata(std::size_t taps, dsp::Hertz rate, const std::string& pin) {
  std::string text = fmt::format(
      "[global]\nsigrok version=0.5.2\n\n[device 1]\ncapturefile=logic-1\ntotal probes=2\n"
      "samplerate={:.0f} Hz\ntotal analog={}\nprobe1=tx\nprobe2={}\n",
      rate.value, taps, pin);
  for (std::size_t i = 0; i < taps; ++i)
    text += fmt::format("analog{}={}\n", i + 3, analogue_taps()[i].name);
  return text + "unitsize=1\n";
}

std::string analogue_samples(const std::vector<float>& tap) {
  std::string bytes(reinterpret_cast<const char*>(tap.data()), sizeof(float));
  return bytes.append(reinterpret_cast<const char*>(tap.data()), tap.size() * sizeof(float));
}

}  // namespace

std::string trace_as_session(const TracedTrial& trial) {
  const std::size_t readings = trial.taps.irradiance.size();
  const dsp::Hertz rate = readings > 0 ? trial.sample_rate : logic_rate;
  ZipImage zip;
  zip.add(std::string(first_member), trial.origin.scenario_toml);
  zip.add("version", "2");
  zip.add("metadata", metadata(readings > 0 ? analogue_taps().size() : 0, rate, trial.pin));
  zip.add("logic-1-1",
          readings > 0 ? logic_samples(trial, readings + 1, rate) : trace_as_raw(trial));
  for (std::size_t i = 0; readings > 0 && i < analogue_taps().size(); ++i)
    zip.add(fmt::format("analog-1-{}-1", i + 3),
            analogue_samples(trial.taps.*analogue_taps()[i].samples));
  return zip.bytes();
}

std::string wire_as_session(const dsp::LogicTrace& wire, dsp::Hertz rate) {
  dsp::TraceReader reader(wire);
  std::string samples(static_cast<std::size_t>(std::ceil(dsp::cycles(wire.end(), rate))), '\0');
  for (std::size_t i = 0; i < samples.size(); ++i)
    samples[i] = reader.level_at(dsp::Seconds(static_cast<double>(i) / rate.value)) ? '\1' : '\0';
  ZipImage zip;
  zip.add("version", "2");
  zip.add("metadata",
          fmt::format("[global]\nsigrok version=0.5.2\n\n[device 1]\ncapturefile=logic-1\n"
                      "total probes=1\nsamplerate={:.0f} Hz\ntotal analog=0\nprobe1=rx\n"
                      "unitsize=1\n",
                      rate.value));
  zip.add("logic-1-1", std::move(samples));
  return zip.bytes();
}

bool is_session_of_trace(const std::filesystem::path& path) {
  constexpr std::size_t name_at = 30;  // of a zip's first member
  const std::string head = beginning_of(path, name_at + first_member.size());
  return head.starts_with("PK\x03\x04") && head.ends_with(first_member);
}

}  // namespace sim
