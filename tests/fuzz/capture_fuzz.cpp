// A reader of captures against any bytes (libFuzzer): it reads or refuses them, in bounded memory.
// COSYS_FORMAT is the format; of SigMF the first line is the metadata, and the rest the data.
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "sim/capture/autobaud.hpp"
#include "sim/capture/capture_file.hpp"
#include "sim/capture/carrier_demodulator.hpp"
#include "sim/capture/sampled_line.hpp"
#include "sim/failure.hpp"

namespace {

namespace fs = std::filesystem;

/// A folder for this process, gone at its end.
class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "cosys-fuzz.XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  fs::path file(const char* name) const { return path_ / name; }

 private:
  fs::path path_;
};

void write(const fs::path& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

fs::path written(std::string_view bytes) {
  static const Folder folder;
  const bool two = std::string_view(COSYS_FORMAT) == "sigmf-meta";
  const std::size_t end = two ? std::min(bytes.find('\n'), bytes.size()) : bytes.size();
  if (two) write(folder.file("capture.sigmf-data"), bytes.substr(std::min(end + 1, bytes.size())));
  write(folder.file("capture.sigmf-meta"), bytes.substr(0, end));
  return folder.file("capture.sigmf-meta");
}

void read_line(sim::EdgeSource& line) {
  std::vector<dsp::Seconds> edges;
  while (const auto edge = line.next())
    if (edges.size() < 1000) edges.push_back(*edge);
  sim::survey_line({line.initial(), edges, line.known_until()}, {}, {});
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const bool raw = std::string_view(COSYS_FORMAT) == "bin";
    const sim::CaptureSettings settings{"", raw ? std::optional(dsp::Hertz(1e6)) : std::nullopt,
                                        COSYS_FORMAT};
    const sim::Capture capture =
        sim::open_capture(written({reinterpret_cast<const char*>(data), size}), settings);
    if (capture.logic) {
      sim::WireEdges wire(*capture.logic, capture.wire);
      sim::CarrierDemodulator line(wire, {});
      read_line(line);
    } else {
      sim::SampledLine line(*capture.samples, {});
      read_line(line);
    }
  } catch (const sim::Failure&) {
    return 0;  // refused
  }
  return 0;
}
