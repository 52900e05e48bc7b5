#pragma once
// A decoder that is a program of the user's, in whatever language: it is given captures and says
// what it decoded.
//
// Once (the default): the command runs for each capture. One of the words of line_captures() in
// braces stands for the capture's file; without any the edges come on stdin. What it prints is the
// bytes that it received, or accepted messages, a line each.
//
// Serve: the command runs all the time. Each capture comes on its stdin, and its answer is wanted
// on its stdout: in both directions a line with the number of bytes that follow, and those bytes.
// The end of stdin is the end.
#include <chrono>
#include <memory>
#include <string>

#include "sim/check/decoder.hpp"

namespace sim {

struct ProgramSettings {
  bool serves = false;                        // runs all the time
  bool prints_frames = false;                 // lines of messages, not bytes
  std::chrono::duration<double> timeout{60};  // for a capture
};

/// Throws Failure(bad_input) for a command that asks for two formats, or for a file to serve from.
/// Other words in braces are the command's own, as of awk.
std::unique_ptr<Decoder> make_program_decoder(const std::string& command,
                                              const ProgramSettings& settings);

/// One that is built in, by its name, or a command. Throws Failure(bad_input) for a single word
/// that is neither.
std::unique_ptr<Decoder> make_decoder(const std::string& name, const ProgramSettings& settings);

}  // namespace sim
