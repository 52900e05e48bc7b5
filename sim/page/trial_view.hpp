#pragma once
// One trial for the script of a page: every tap of the receiver on one time axis, to zoom and pan
// in, with what was sent and read written along it.
#include <string>
#include <vector>

#include "sim/trace/trace.hpp"

namespace sim {

/// Samples, or where they would be too many the least and the greatest of each stretch in turn, so
/// that no spike is lost; then there are also all samples from a little before the character that
/// is shown first.
struct TapValues {
  std::string key, name, unit;
  std::vector<float> values, detail = {};
};

struct ViewMark {
  double at_s;
  std::string text;
  bool is_wrong;
};

/// Seconds are since the message began.
struct TrialView {
  double first_s = 0, period_s = 1;  // of the values
  std::size_t stretch = 1;           // samples of which two values are kept; 1 where all are
  double detail_first_s = 0;         // of the detail
  std::vector<TapValues> taps;
  bool wire_begins = true;           // level of the pin at first
  std::vector<double> wire_edges_s;  // of the pin
  std::vector<ViewMark> sent, read;  // characters, at their middles
  std::vector<ViewMark> bits;        // at the middle of each that was sent, the pin's level for it
  double delay_s = 0;                // how much later the pin has it
  double message_s = 0;              // how long it is
  double byte_from_s = 0, byte_s = 0;     // the character that is shown first: one that was misread
  double edge_from_s = 0, edge_to_s = 0;  // cycles of the carrier, where it goes wrong
};

/// Of a trial with taps and a message. At most `most` values a tap, and half as many of its detail.
TrialView view_of(const TracedTrial& trial, std::size_t most = 1'000'000);

/// As JSON. Values in steps of 1/65535 of their range, as base64 of 16-bit numbers (least byte
/// first).
std::string view_json(const TrialView& view);

}  // namespace sim
