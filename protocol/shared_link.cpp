#include "protocol/shared_link.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

#include "protocol/ascii.hpp"

namespace protocol {
namespace {

constexpr std::string_view field_letters = "NDQR";
constexpr std::string_view line_end = "\r\n";
constexpr std::size_t brackets = 2;
constexpr std::size_t checksum_size = 4;  // |Cxx

std::string text_before_checksum(const SharedLinkMessage& message) {
  return ':' + shared_link_text(message);
}

/// What is between the separators behind the addresses, without its first one.
std::vector<std::string_view> split_fields(std::string_view text) {
  std::vector<std::string_view> fields;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find('|', from), text.size());
    fields.push_back(text.substr(from, to - from));
    from = to + 1;
  }
  return fields;
}

bool has_addresses(std::string_view text) {
  return text.size() > 3 && is_address(text[1]) && is_address(text[2]) && text[3] == '|';
}

/// The field of such a text; nothing if its letter is unknown.
std::optional<SharedLinkField> to_field(std::string_view text) {
  if (text.empty() || field_letters.find(text[0]) == std::string_view::npos) return std::nullopt;
  return SharedLinkField{static_cast<SharedLinkFieldType>(text[0]), std::string(text.substr(1))};
}

SharedLinkOutcome judge_checksum(std::string_view text, std::string_view last_field) {
  if (!last_field.starts_with('C')) return SharedLinkOutcome::no_checksum;
  const auto checksum = parse_hex_byte(last_field.substr(1));
  if (!checksum) return SharedLinkOutcome::not_hex;
  const std::string_view summed = text.substr(0, text.size() - last_field.size() + 1);
  return *checksum == shared_link_checksum(summed) ? SharedLinkOutcome::ok
                                                   : SharedLinkOutcome::wrong_checksum;
}

/// Of a text between brackets; fills the message if it is one.
SharedLinkOutcome judge_message(std::string_view text, SharedLinkMessage& message) {
  if (!std::ranges::all_of(text, is_printable)) return SharedLinkOutcome::unprintable;
  if (!text.starts_with(':')) return SharedLinkOutcome::no_header;
  if (!has_addresses(text)) return SharedLinkOutcome::bad_address;
  std::vector<std::string_view> fields = split_fields(text.substr(4));
  const SharedLinkOutcome checked = judge_checksum(text, fields.back());
  if (checked != SharedLinkOutcome::ok) return checked;
  fields.pop_back();
  message = {text[1], text[2], {}};
  for (const std::string_view field : fields) {
    auto known = to_field(field);
    if (!known) return SharedLinkOutcome::unknown_field;
    message.fields.push_back(std::move(*known));
  }
  return SharedLinkOutcome::ok;
}

}  // namespace

std::uint8_t shared_link_checksum(std::string_view characters) {
  return std::accumulate(characters.begin(), characters.end(), std::uint8_t{0},
                         [](std::uint8_t sum, char c) {
                           return static_cast<std::uint8_t>(sum + static_cast<std::uint8_t>(c));
                         });
}

std::string shared_link_text(const SharedLinkMessage& message) {
  std::string text{message.destination, message.source};
  for (const SharedLinkField& field : message.fields)
    text += std::string{'|', static_cast<char>(field.type)} + field.text;
  return text;
}

std::optional<std::string> parse_shared_link(std::string_view text, SharedLinkMessage& message) {
  if (text.size() < 2 || (text.size() > 2 && text[2] != '|'))
    return "it does not begin with two addresses and a |";
  message = {text[0], text[1], {}};
  if (text.size() == 2) return std::nullopt;
  for (const std::string_view field : split_fields(text.substr(3))) {
    auto known = to_field(field);
    if (!known)
      return "field \"" + std::string(field) + "\" does not begin with one of the letters " +
             std::string(field_letters);
    message.fields.push_back(std::move(*known));
  }
  return std::nullopt;
}

std::size_t shared_link_size(const SharedLinkMessage& message) {
  return text_before_checksum(message).size() + checksum_size + brackets + line_end.size();
}

std::optional<std::string> problem_in_text(std::string_view text) {
  const auto allowed = [](char c) { return is_printable(c) && c != '[' && c != ']' && c != '|'; };
  const auto* bad = std::ranges::find_if_not(text, allowed);
  if (bad == text.end()) return std::nullopt;
  const std::string place = " at position " + std::to_string(bad - text.begin());
  if (is_printable(*bad)) return std::string{'\'', *bad, '\''} + place + " belongs to the format";
  return "byte 0x" + hex_byte(static_cast<std::uint8_t>(*bad)) + place +
         " is not printable ASCII, 0x20 to 0x7e";
}

std::optional<std::string> problem_in_message(const SharedLinkMessage& message,
                                              std::size_t max_size) {
  for (const char address : {message.destination, message.source})
    if (!is_address(address))
      return std::string{'\'', address, '\''} + " is no address, 'A' to 'P'";
  for (const SharedLinkField& field : message.fields)
    if (auto problem = problem_in_text(field.text)) return problem;
  const std::size_t size = shared_link_size(message);
  if (size <= max_size) return std::nullopt;
  return "it would be " + std::to_string(size) + " bytes long, " + std::to_string(size - max_size) +
         " over the limit of " + std::to_string(max_size);
}

Bytes shared_link_encode(const SharedLinkMessage& message) {
  assert(!problem_in_message(message, std::string::npos));
  std::string text = text_before_checksum(message) + "|C";
  std::string checksum = hex_byte(shared_link_checksum(text));
  std::ranges::transform(checksum, checksum.begin(), upper_case);
  text = "[" + text + checksum + "]" + std::string(line_end);
  return {text.begin(), text.end()};
}

SharedLinkDecoder::SharedLinkDecoder(std::size_t max_size)
    : longest_text_(max_size - brackets - line_end.size()) {
  assert(max_size > brackets + line_end.size());
}

std::optional<SharedLinkFrame> SharedLinkDecoder::push(const UartByte& byte) {
  const char c = static_cast<char>(byte.value);
  if (c == '[') {
    const bool unended = std::exchange(inside_, true);
    std::optional<SharedLinkFrame> cut;
    if (unended) cut = take(SharedLinkOutcome::unended);
    start_ = byte.start;
    return cut;
  }
  if (!inside_) return std::nullopt;
  if (c == ']') {
    inside_ = false;
    SharedLinkMessage message;
    const SharedLinkOutcome outcome = judge_message(text_, message);
    SharedLinkFrame frame = take(outcome);
    if (outcome == SharedLinkOutcome::ok) frame.message = std::move(message);
    return frame;
  }
  if (text_.size() < longest_text_) {
    text_.push_back(c);
    return std::nullopt;
  }
  inside_ = false;
  return take(SharedLinkOutcome::overlong);
}

SharedLinkFrame SharedLinkDecoder::take(SharedLinkOutcome outcome) {
  return {outcome, {}, std::exchange(text_, {}), start_};
}

}  // namespace protocol
