#pragma once
// The COSYS line that soft characters are, by its checksum. The XOR makes of each bit column of the
// text a single parity check code, whose best word is found by Wagner's rule: where the parity is
// wrong, the least sure bit is (Silverman and Balser, Proc. IRE 42, 1954). Done for each of the 128
// checksums with what its own two digits cost, that is the best of all lines of that length.
#include <limits>
#include <span>
#include <string>

#include "protocol/soft_characters.hpp"

namespace protocol {

struct SoftLine {
  std::string message;
  /// Time at the wrong level in the whole line, in bits.
  double mismatch = 0;
  /// How much of it is for what was changed because of space, newline and checksum.
  double corrected = std::numeric_limits<double>::infinity();
  /// How much worse the best other message of that length is.
  double margin = 0;
};

/// Of characters from the first of a device message to the newline. Nothing is right about it but
/// the checksum: see `corrected` and `margin`.
SoftLine best_line(std::span<const SoftCharacter> characters);

}  // namespace protocol
