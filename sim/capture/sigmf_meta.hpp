#pragma once
// What the metadata of a SigMF recording say of its samples (sigmf/SigMF 1.2, sigmf-schema.json).
// What is not understood and may change how samples are read is refused by its name: extensions
// that are not optional, other fields of the core, samples that are missing between captures, and a
// baseband whose middle moves. Annotations are not needed.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dsp/units.hpp"
#include "sim/capture/capture_file.hpp"
#include "sim/failure.hpp"

namespace sim {

struct SigmfNumber {
  std::size_t bytes = 1;
  double (*read)(const unsigned char* bytes) = nullptr;  // in the machine's byte order
  double middle = 0;                                     // what stands for 0
};

/// Bytes that are no samples stand before this one.
struct SigmfSegment {
  std::uint64_t first_sample = 0;  // counted from the file's first
  std::uint64_t header_bytes = 0;
};

struct SigmfLayout {
  bool is_complex = false, swapped = false;
  SigmfNumber number;
  std::size_t channels = 1;
  dsp::Hertz sample_rate;
  std::filesystem::path data;
  std::vector<SigmfSegment> segments;  // in the order of their samples
  std::uint64_t trailing_bytes = 0;

  std::size_t numbers_a_sample() const { return is_complex ? 2 : 1; }
  std::size_t frame_bytes() const { return channels * numbers_a_sample() * number.bytes; }
};

Failure unreadable_recording(const std::filesystem::path& meta, const std::string& why,
                             const std::string& suggestion = "give a SigMF recording, version 1");

/// NAME.sigmf-data of NAME.sigmf-meta, or the other way round; in capitals of one in capitals.
std::filesystem::path sigmf_beside(const std::filesystem::path& file, std::string ending);

/// Throws Failure(bad_input).
SigmfLayout read_sigmf_meta(const std::filesystem::path& meta, const CaptureSettings& settings);

}  // namespace sim
