#pragma once
// LogicCapture: the wires of a logic analyser's capture, level by level in the order of time and in
// memory that does not grow with the file. What cannot be read is thrown as Failure(bad_input) with
// the file's name, and the line where there are lines.
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "dsp/logic_trace.hpp"
#include "dsp/units.hpp"

namespace sim {

struct WireLevel {
  std::size_t wire = 0;  // its place in wires()
  dsp::Seconds at;       // does not decrease
  bool level = true;
  bool initial = false;  // the wire was so from the start: no edge
};

class LogicCapture {
 public:
  LogicCapture() = default;
  LogicCapture(const LogicCapture&) = delete;
  LogicCapture& operator=(const LogicCapture&) = delete;
  virtual ~LogicCapture() = default;

  virtual const std::vector<std::string>& wires() const = 0;
  /// A level may repeat the one before. A wire of which no initial level comes was 1, as an idle
  /// line is. Nothing: the capture is over.
  virtual std::optional<WireLevel> next() = 0;
  /// Until when the wires were observed, as far as it was read.
  virtual dsp::Seconds now() const = 0;
  /// Between two samples; 0 where changes have an instant of their own.
  virtual dsp::Seconds resolution() const { return {}; }
};

/// One wire, edge by edge in the order of time; no two edges are at one instant.
class EdgeSource {
 public:
  EdgeSource() = default;
  EdgeSource(const EdgeSource&) = delete;
  EdgeSource& operator=(const EdgeSource&) = delete;
  virtual ~EdgeSource() = default;

  virtual bool initial() const = 0;
  virtual std::optional<dsp::Seconds> next() = 0;
  /// Every edge before it was given.
  virtual dsp::Seconds known_until() const = 0;
  /// Between two samples; 0 where edges are exact.
  virtual dsp::Seconds resolution() const { return {}; }
};

/// One wire of a capture. Two edges at one instant cancel.
class WireEdges : public EdgeSource {
 public:
  /// The capture must outlive it.
  WireEdges(LogicCapture& capture, std::size_t wire);

  bool initial() const override { return initial_; }
  std::optional<dsp::Seconds> next() override;
  dsp::Seconds known_until() const override;
  dsp::Seconds resolution() const override { return capture_.resolution(); }

 private:
  void read_initial();

  LogicCapture& capture_;
  std::size_t wire_;
  bool initial_ = true, level_ = true;
  std::optional<dsp::Seconds> held_;  // an edge that another at its instant may cancel
};

struct NamedTrace {
  std::string name;
  dsp::LogicTrace trace;
};

/// All wires in memory: for captures known to be short.
std::vector<NamedTrace> read_whole(LogicCapture& capture);

}  // namespace sim
