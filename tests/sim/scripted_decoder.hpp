#pragma once
// A decoder that says of each frame what a test wants it to, whatever it hears.
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/check/decoder.hpp"
#include "sim/threads/parallel_runs.hpp"

namespace sim {

/// Those that judge decoders.
inline constexpr Workers two_threads{.threads = 2, .interrupt = nullptr};

class ScriptedDecoder : public Decoder {
 public:
  /// What is accepted between the markers beside a trial.
  using Script = std::function<std::vector<std::string>(std::uint32_t trial)>;
  explicit ScriptedDecoder(Script script, std::optional<std::uint32_t> lost_marker = {})
      : script_(std::move(script)), lost_marker_(lost_marker) {}

  const std::string& name() const override { return name_; }
  Decoded decode(const DelimitedStream& line) const override {
    Decoded decoded;
    const auto end = line.first + static_cast<std::uint32_t>(line.frames.size());
    for (std::uint32_t trial = line.first; trial <= end; ++trial) {
      if (trial != lost_marker_) decoded.accepted.push_back(marker(trial));
      if (trial == end) break;
      for (std::string& message : script_(trial)) decoded.accepted.push_back(std::move(message));
    }
    return decoded;
  }

 private:
  std::string name_ = "scripted";
  Script script_;
  std::optional<std::uint32_t> lost_marker_;
};

/// What a device sends unless told otherwise.
inline const std::string sent_message = "IND 011111 OK";

/// Loses trials from ... end - 1 and no other.
inline ScriptedDecoder::Script losing(std::uint32_t from, std::uint32_t end) {
  return [=](std::uint32_t trial) {
    const bool lost = trial >= from && trial < end;
    return lost ? std::vector<std::string>{} : std::vector{sent_message};
  };
}

}  // namespace sim
