#pragma once
// How much each of several decoders accepts of the same line that the device did not send.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/check/decoder.hpp"
#include "sim/counting/statistics.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/threads/parallel_runs.hpp"

namespace sim {

/// What a decoder accepted of a point's runs.
struct Accepts {
  std::uint64_t n_runs = 0;
  std::uint64_t n_ok = 0;               // the device's message
  std::uint64_t n_wrong = 0;            // any other; where the device is dark, any
  std::uint64_t wrong_squared = 0;      // sum of each run's n_wrong, squared
  std::optional<DecoderFault> fault{};  // the first

  Accepts& operator+=(const Accepts& other);
};

struct FalseAcceptComparisonPoint {
  std::string name;
  double hours_of_a_run = 0;
  std::vector<Accepts> accepts;  // one a decoder

  /// Of a decoder, an hour of line, with the 95 % interval of event_rate; NaN where it failed.
  Estimate wrong_per_hour(std::size_t decoder) const;
};

using Decoders = std::vector<const Decoder*>;

/// All decoders on all runs of a point. Each run is a capture of its own, between two markers.
/// Fewer runs after an interrupt.
FalseAcceptComparisonPoint false_accept_comparison(const LoadedScenario& scenario,
                                                   std::size_t point, const Decoders& decoders,
                                                   const Workers& workers);

std::string false_accept_comparison_text(const std::vector<FalseAcceptComparisonPoint>& points,
                                         const Decoders& decoders);
std::string false_accept_comparison_json(const std::vector<FalseAcceptComparisonPoint>& points,
                                         const Decoders& decoders);

}  // namespace sim
