#pragma once
// Many captures at once: a row each.
#include "sim/command/commands.hpp"

namespace sim {

/// Reads the captures of the request, and of its folders all files whose ending is a capture's, in
/// the order of their names. What cannot be read has a row too. Exit code 3 if the machine failed
/// at one, else 2 if one is no capture, else 4 if one reads as well in two ways. Throws
/// Failure(bad_input) for a folder without any.
ExitCode decode_table(const DecodeRequest& request);

}  // namespace sim
