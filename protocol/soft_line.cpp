#include "protocol/soft_line.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "protocol/ascii.hpp"
#include "protocol/cosys.hpp"

namespace protocol {
namespace {

constexpr double impossible = std::numeric_limits<double>::infinity();
constexpr unsigned checksums = 1U << unsigned{text_bits};

/// One bit of all characters of the text.
struct Column {
  bool parity = false;        // of the likeliest bits
  double least = impossible;  // of |darkness|
  double second_least = impossible;
  std::size_t weakest = 0;  // character

  void add(double darkness, std::size_t character) {
    parity ^= darkness > 0;
    const double sure = std::abs(darkness);
    if (sure >= least) {
      second_least = std::min(second_least, sure);
      return;
    }
    second_least = std::exchange(least, sure);
    weakest = character;
  }

  double cost_of(bool wanted) const { return wanted == parity ? 0 : least; }
  /// Another word of that parity, over the best: two bits changed, or the second weakest instead.
  double margin_of(bool wanted) const {
    if (second_least == impossible) return impossible;
    return wanted == parity ? least + second_least : second_least - least;
  }
};

using Columns = std::array<Column, text_bits>;

Columns columns_of(std::span<const SoftCharacter> text) {
  Columns columns;
  for (std::size_t c = 0; c < text.size(); ++c)
    for (std::size_t i = 0; i < text_bits; ++i) columns[i].add(text[c].darkness[i], c);
  return columns;
}

bool line_bit_of(unsigned checksum, std::size_t i) { return ((checksum >> i) & 1U) != 0; }

double cost_of_digit(const SoftCharacter& character, char digit) {
  return std::min(character.cost_of(static_cast<std::uint8_t>(digit)),
                  character.cost_of(static_cast<std::uint8_t>(upper_case(digit))));
}

double cost_of_checksum(const Columns& columns, std::span<const SoftCharacter> digits,
                        unsigned checksum) {
  const std::string hex = hex_byte(static_cast<std::uint8_t>(checksum));
  double cost = cost_of_digit(digits[0], hex[0]) + cost_of_digit(digits[1], hex[1]);
  for (std::size_t i = 0; i < text_bits; ++i) cost += columns[i].cost_of(line_bit_of(checksum, i));
  return cost;
}

struct BestChecksum {
  unsigned checksum = 0;
  double cost = impossible;
  double next_cost = impossible;  // of another
};

BestChecksum best_checksum(const Columns& columns, std::span<const SoftCharacter> digits) {
  BestChecksum best;
  for (unsigned checksum = 0; checksum < checksums; ++checksum) {
    const double cost = cost_of_checksum(columns, digits, checksum);
    if (cost < best.cost) {
      best = {checksum, cost, best.cost};
    } else {
      best.next_cost = std::min(best.next_cost, cost);
    }
  }
  return best;
}

std::string text_of(std::span<const SoftCharacter> text, const Columns& columns,
                    unsigned checksum) {
  std::string message;
  for (const SoftCharacter& character : text)
    message.push_back(static_cast<char>(character.value()));
  for (std::size_t i = 0; i < text_bits && !text.empty(); ++i)
    if (columns[i].parity != line_bit_of(checksum, i))
      message[columns[i].weakest] = static_cast<char>(message[columns[i].weakest] ^ (1 << i));
  return message;
}

}  // namespace

SoftLine best_line(std::span<const SoftCharacter> characters) {
  if (characters.size() < tail_size) return {};
  const auto text = characters.first(characters.size() - tail_size);
  const auto tail = characters.last(tail_size);
  const Columns columns = columns_of(text);
  const BestChecksum best = best_checksum(columns, tail.subspan(1, 2));
  SoftLine line;
  line.message = text_of(text, columns, best.checksum);
  line.corrected = best.cost + tail.front().cost_of(' ') + tail.back().cost_of('\n');
  line.margin = best.next_cost - best.cost;
  for (std::size_t i = 0; i < text_bits; ++i)
    line.margin = std::min(line.margin, columns[i].margin_of(line_bit_of(best.checksum, i)));
  line.mismatch = line.corrected;
  for (const SoftCharacter& character : characters) line.mismatch += character.mismatch;
  return line;
}

}  // namespace protocol
