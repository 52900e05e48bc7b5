#pragma once
// VCD texts read in tests.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "sim/capture/vcd_capture.hpp"
#include "sim/failure.hpp"

namespace sim {

inline std::vector<NamedTrace> wires_in(const std::string& text,
                                        const CaptureSettings& settings = {}) {
  std::istringstream in(text);
  CaptureFacts facts;
  return read_whole(*open_vcd(in, "a.vcd", settings, facts));
}

inline CaptureSettings with_tick(dsp::Seconds tick) { return {"", {}, "", {}, tick}; }
inline CaptureSettings with_wire(const std::string& wire) { return {wire, {}, ""}; }

/// A file with one wire `rx` of code `!` and this body.
inline std::string file_of_one_wire(const std::string& body,
                                    const std::string& timescale = "1 us") {
  return "$timescale " + timescale + " $end $var wire 1 ! rx $end $enddefinitions $end\n" + body;
}

inline std::vector<double> edges_to_ns(const dsp::LogicTrace& trace) {
  std::vector<double> times;
  for (const dsp::Seconds edge : trace.edges()) times.push_back(std::round(edge.value * 1e9) / 1e3);
  return times;
}

template <class Read>
std::string vcd_failure(const Read& read) {
  try {
    read();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::bad_input);
    return failure.what();
  }
  return "no failure";
}

inline std::string vcd_failure(const std::string& text) {
  return vcd_failure([&] { wires_in(text); });
}

}  // namespace sim
