#include "protocol/cosys.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

#include "protocol/ascii.hpp"

namespace protocol {
namespace {

CosysOutcome judge_line(std::string_view line) {
  if (!std::ranges::all_of(line, is_printable)) return CosysOutcome::unprintable;
  const std::size_t space = line.rfind(' ');
  if (space == std::string_view::npos || line.size() - space < tail_size - 1)
    return CosysOutcome::too_short;
  const auto checksum = parse_hex_byte(line.substr(space + 1));
  if (!checksum) return CosysOutcome::not_hex;
  const bool right = *checksum == cosys_checksum(line.substr(0, space));
  return right ? CosysOutcome::ok : CosysOutcome::wrong_checksum;
}

}  // namespace

std::uint8_t cosys_checksum(std::string_view device_message) {
  return std::accumulate(
      device_message.begin(), device_message.end(), std::uint8_t{0},
      [](std::uint8_t sum, char c) -> std::uint8_t { return sum ^ static_cast<std::uint8_t>(c); });
}

std::optional<std::string> problem_in_message(std::string_view device_message,
                                              std::size_t max_line) {
  const auto* bad = std::ranges::find_if_not(device_message, is_printable);
  if (bad != device_message.end()) {
    return "byte 0x" + hex_byte(static_cast<std::uint8_t>(*bad)) + " at position " +
           std::to_string(bad - device_message.begin()) + " is not printable ASCII, 0x20 to 0x7e";
  }
  const std::size_t line_size = device_message.size() + tail_size;
  if (line_size <= max_line) return std::nullopt;
  return "its line would be " + std::to_string(line_size) + " bytes long, " +
         std::to_string(line_size - max_line) + " over the limit of " + std::to_string(max_line);
}

Bytes cosys_encode(std::string_view device_message) {
  assert(!problem_in_message(device_message));
  const std::string tail = ' ' + hex_byte(cosys_checksum(device_message)) + '\n';
  Bytes bytes(device_message.begin(), device_message.end());
  bytes.insert(bytes.end(), tail.begin(), tail.end());
  return bytes;
}

CosysDecoder::CosysDecoder(std::size_t max_line) : max_line_(max_line) { assert(max_line > 0); }

std::optional<CosysFrame> CosysDecoder::push(const UartByte& byte) {
  const bool newline = byte.value == '\n';
  if (dropping_) {
    dropping_ = !newline;
    return std::nullopt;
  }
  if (line_.empty()) start_ = byte.start;
  if (newline) return take_line(judge_line(line_));
  line_.push_back(static_cast<char>(byte.value));
  if (line_.size() < max_line_) return std::nullopt;
  dropping_ = true;
  return take_line(CosysOutcome::overlong);
}

CosysFrame CosysDecoder::take_line(CosysOutcome outcome) {
  if (outcome == CosysOutcome::ok) line_.resize(line_.size() - (tail_size - 1));
  return {outcome, std::exchange(line_, {}), start_};
}

}  // namespace protocol
