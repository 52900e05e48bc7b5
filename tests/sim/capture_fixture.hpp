#pragma once
// A capture from a text, in a file of its own: what is read of it, or why it is refused.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <complex>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "capture_lines.hpp"
#include "sim/capture/capture_file.hpp"

namespace sim {

class CaptureFormat : public testing::Test {
 protected:
  CaptureFormat()
      : path_(std::filesystem::temp_directory_path() /
              ("cosys-capture-test-" + std::to_string(::getpid()))) {}
  ~CaptureFormat() override { std::filesystem::remove(path_); }

  Capture open(const std::string& content, const std::string& format,
               const std::string& wire = "") const {
    std::ofstream(path_, std::ios::binary) << content;
    const bool raw = format == "bin";
    return open_capture(path_, {wire, raw ? std::optional(dsp::Hertz(1e6)) : std::nullopt, format});
  }

  std::vector<NamedTrace> wires(const std::string& content, const std::string& format) const {
    const Capture capture = open(content, format);
    return capture.logic ? read_whole(*capture.logic) : std::vector<NamedTrace>{};
  }

  std::vector<float> samples(const std::string& content, const std::string& wire = "") const {
    const Capture capture = open(content, "csv", wire);
    std::vector<float> values;
    std::array<std::complex<float>, 3> block;
    while (const std::size_t n = capture.samples->read(block))
      for (std::size_t i = 0; i < n; ++i) values.push_back(block[i].real());
    return values;
  }

  std::string refusal(const std::string& content, const std::string& format,
                      const std::string& wire = "") const {
    const std::string message = test::failure_of([&] {
      const Capture capture = open(content, format, wire);
      if (capture.logic) read_whole(*capture.logic);
    });
    const std::size_t name = message.find(path_.string());
    return name == std::string::npos
               ? message
               : message.substr(0, name) + "FILE" + message.substr(name + path_.string().size());
  }

  std::filesystem::path path_;
};

}  // namespace sim
