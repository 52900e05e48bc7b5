#include "sim/false_accepts/false_accept_report.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "sim/columns/stop_column.hpp"
#include "sim/columns/validity_column.hpp"
#include "sim/false_accepts/false_accept_keys.hpp"

namespace sim {
namespace {

using Point = FalseAcceptPoint;

bool may_send(const LoadedScenario& scenario) {
  return scenario.base.settings.of<FalseAcceptSettings>().device_sends != 0 ||
         std::ranges::find(scenario.sweep, "listening.device_sends", &Axis::key) !=
             scenario.sweep.end();
}

Column<Point>& add_count(Columns<Point>& columns, VariableFacts facts,
                         std::uint64_t FalseAcceptTally::*count,
                         const TextColumn& heading = {{}, 0}) {
  return columns.count(std::move(facts), [count](const Point& p) { return p.tally.*count; })
      .headed(heading);
}

void add_line(Columns<Point>& columns) {
  using T = FalseAcceptTally;
  add_count(columns, {"n_runs", "1", "runs"}, &T::n_runs);
  columns.real({"line_h", "h", "time listened to the line"}, [](const Point& p) { return p.hours; })
      .headed({{"hours", "of line", "[h]"}, 8});
}

/// Where the device may send.
void add_sent(Columns<Point>& columns) {
  using T = FalseAcceptTally;
  add_count(columns, {"n_frames", "1", "messages that the device sent"}, &T::n_frames,
            {{"messages", "", "sent"}, 8})
      .shown_if(may_send);
  add_count(columns, {"n_frames_ok", "1", "messages accepted as sent"}, &T::n_frames_ok,
            {{"", "", "delivered"}, 9})
      .shown_if(may_send);
  add_count(columns, {"n_frames_undetected", "1", "messages accepted while another was sent"},
            &T::n_frames_undetected, {{"undetected", "", "errors"}, number_width})
      .shown_if(may_send);
  columns
      .ratio({"undetected_per_hour", "1/h",
              "messages accepted while another was sent per hour of line"},
             [](const Point& p) { return p.undetected_per_hour(); })
      .headed({{"undetected errors", "[1/h]", "[interval]"}, -estimate_width})
      .drawn({"Undetected errors", "Undetected errors an hour of line", true})
      .shown_if(may_send);
}

void add_false(Columns<Point>& columns) {
  using T = FalseAcceptTally;
  add_count(columns, {"n_frames_false", "1", "messages accepted while none was sent"},
            &T::n_frames_false, {{"", "false", "accepts"}, 8});
  columns
      .ratio({"false_per_hour", "1/h", "messages accepted while none was sent per hour of line"},
             [](const Point& p) { return p.false_per_hour(); })
      .headed({{"false accepts", "[1/h]", "[interval]"}, -estimate_width})
      .drawn({"False accepts", "False accepts an hour of line", true});
}

void add_light(Columns<Point>& columns) {
  columns.real({"irradiance_mw_per_m2", "mW/m2", "light of the device, if it sends"},
               [](const Point& p) {
                 return p.tally.n_frames == 0 ? std::numeric_limits<double>::quiet_NaN()
                                              : p.operating.irradiance_mw_per_m2;
               });
  columns.real({"ambient_w_per_m2", "W/m2", "all steady light, means included"},
               [](const Point& p) { return p.operating.ambient_w_per_m2; });
}

Columns<Point> made_columns() {
  using T = FalseAcceptTally;
  Columns<Point> columns;
  add_line(columns);
  add_sent(columns);
  add_false(columns);
  add_count(columns, {"n_rejected", "1", "lines that ended and were refused"}, &T::n_rejected,
            {{"", "lines", "refused"}, 8});
  add_count(columns, {"n_characters", "1", "characters that the UART read"}, &T::n_characters,
            {{"", "characters", "read"}, number_width});
  add_light(columns);
  add_stop_reason(columns);
  add_validity_flags(columns);
  return columns;
}

}  // namespace

const Columns<FalseAcceptPoint>& false_accept_columns() {
  static const Columns<FalseAcceptPoint> columns = made_columns();
  return columns;
}

constinit const PointReport<FalseAcceptPoint> false_accept_report{false_accept_columns, nullptr};

}  // namespace sim
