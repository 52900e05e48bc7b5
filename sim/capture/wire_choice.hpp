#pragma once
// Which wire of a capture is read: the one that was asked for, else by what is on them. A wire
// without an edge is never preferred. One that is called rx (in any case, at the end of its name
// too) comes before others, then one with whole messages, then the one whose characters make most
// sense.
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/capture/line_survey.hpp"
#include "sim/capture/logic_capture.hpp"

namespace sim {

/// A wire or column, as far as it was looked at.
struct WireSurvey {
  std::string name;
  std::uint64_t edges = 0;
  LineFacts facts;
};

struct WireChoice {
  std::size_t wire = 0;
  std::optional<std::size_t> rival;  // another that reads as well
};

/// By what is on them; there is at least one.
WireChoice choice_of_wire(const std::vector<WireSurvey>& wires);

/// The wire of this name, in any case where no other is so called, or of this number, the first
/// being 1, where no name is a number. Throws bad_input, naming all.
std::size_t named_wire(const std::vector<std::string>& wires, const std::string& wanted,
                       const std::string& file);

/// What the user says of the line.
struct LineHints {
  std::optional<bool> inverted;
  std::optional<dsp::Hertz> baud, carrier;
};

/// A capture whose beginning is looked at before it is read from the start on: the first half
/// million levels, in bounded memory.
class SurveyedCapture : public LogicCapture {
 public:
  SurveyedCapture(std::unique_ptr<LogicCapture> capture, const LineHints& hints);

  const std::vector<std::string>& wires() const override { return capture_->wires(); }
  std::optional<WireLevel> next() override;
  dsp::Seconds now() const override;

  const std::vector<WireSurvey>& surveys() const { return surveys_; }
  /// Whether all of the capture was looked at.
  bool is_whole() const { return whole_; }

 private:
  void read_ahead();

  std::unique_ptr<LogicCapture> capture_;
  std::deque<WireLevel> ahead_;
  dsp::Seconds now_, end_;
  bool whole_ = false, is_played_ = false;  // read to its end; played back to where reading stopped
  std::vector<WireSurvey> surveys_;
};

}  // namespace sim
