#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "sim/listening/listening_report.hpp"
#include "sim/report/outside_report.hpp"

namespace sim {
namespace {

using Points = std::vector<ListeningPoint>;

void add_count(Dataset& data, const Points& points, VariableFacts facts,
               std::uint64_t ListeningTally::*count) {
  std::vector<std::int64_t> values;
  for (const ListeningPoint& p : points)
    values.push_back(static_cast<std::int64_t>(p.tally.*count));
  data.variables.push_back({std::move(facts), true, {}, std::move(values)});
}

/// NaN where a point was never reached.
template <class Read>
void add_real(Dataset& data, const Points& points, VariableFacts facts, const Read& read) {
  std::vector<double> values;
  for (const ListeningPoint& p : points)
    values.push_back(p.reached() ? read(p) : std::numeric_limits<double>::quiet_NaN());
  data.variables.push_back({std::move(facts), true, {}, std::move(values)});
}

void add_rate(Dataset& data, const Points& points, const std::string& name, const std::string& what,
              Estimate (ListeningPoint::*rate)() const) {
  const auto add = [&](const std::string& suffix, const std::string& of, double Estimate::*part) {
    add_real(data, points, {name + suffix, "1/h", of + what + " per hour of line"},
             [=](const ListeningPoint& p) { return (p.*rate)().*part; });
  };
  add("", "", &Estimate::value);
  add("_ci_low", "lower end of the 95 % interval of ", &Estimate::low);
  add("_ci_high", "upper end of the 95 % interval of ", &Estimate::high);
}

void add_counts(Dataset& data, const Points& points) {
  using T = ListeningTally;
  add_count(data, points, {"n_runs", "1", "runs"}, &T::n_runs);
  add_count(data, points, {"n_frames", "1", "messages that the device sent"}, &T::n_frames);
  add_count(data, points, {"n_frames_ok", "1", "messages accepted as sent"}, &T::n_frames_ok);
  add_count(data, points, {"n_frames_undetected", "1", "messages accepted while another was sent"},
            &T::n_frames_undetected);
  add_count(data, points, {"n_frames_false", "1", "messages accepted while none was sent"},
            &T::n_frames_false);
  add_count(data, points, {"n_rejected", "1", "lines that ended and were refused"}, &T::n_rejected);
  add_count(data, points, {"n_characters", "1", "characters that the UART read"}, &T::n_characters);
}

}  // namespace

Dataset listening_dataset(const LoadedScenario& scenario, const std::string& command,
                          const Points& points) {
  Dataset data = dataset_of(scenario, command);
  for (const ListeningPoint& point : points) data.n_runs += point.tally.n_runs;
  add_counts(data, points);
  add_real(data, points, {"line_h", "h", "time listened to the line"},
           [](const ListeningPoint& p) { return p.hours; });
  add_rate(data, points, "false_per_hour", "messages accepted while none was sent",
           &ListeningPoint::false_per_hour);
  add_rate(data, points, "undetected_per_hour", "messages accepted while another was sent",
           &ListeningPoint::undetected_per_hour);
  add_real(data, points, {"irradiance_mw_per_m2", "mW/m2", "light of the device, if it sends"},
           [](const ListeningPoint& p) {
             return p.tally.n_frames == 0 ? std::numeric_limits<double>::quiet_NaN()
                                          : p.operating.irradiance_mw_per_m2;
           });
  add_real(data, points, {"ambient_w_per_m2", "W/m2", "all steady light, means included"},
           [](const ListeningPoint& p) { return p.operating.ambient_w_per_m2; });
  std::vector<std::int64_t> outside;
  for (const ListeningPoint& p : points) outside.push_back(static_cast<std::int64_t>(p.outside));
  data.variables.push_back(outside_variable(std::move(outside)));
  return data;
}

}  // namespace sim
