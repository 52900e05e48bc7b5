#include "sim/serve/serve_report.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/text/escaped_text.hpp"
#include "sim/text/json_answer.hpp"

namespace sim {

using Json = nlohmann::ordered_json;

std::string message_line(const LineMessage& message, dsp::Seconds origin,
                         const LineVerdict& verdict, std::uint64_t bytes_lost) {
  const Json line = {
      {"message", message.number},
      {"time_s", std::round((origin + message.start).value * 1e6) / 1e6},
      {"sent", escaped(message.sent)},
      {"heard", verdict.heard},
      {"outcome", verdict.outcome},
      {"framing_errors", std::ranges::count(message.bytes, true, &LineByte::framing_error)},
      {"bytes_lost", bytes_lost}};
  return json_line(line);
}

std::string lost_lines(std::uint64_t lines) { return json_line({{"lost_lines", lines}}); }

}  // namespace sim
