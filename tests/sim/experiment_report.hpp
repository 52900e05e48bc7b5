#pragma once
// `cosys-sim report` of experiments that are no links, beside what `run` counted of them.
#include <nlohmann/json.hpp>

#include "report_case.hpp"

namespace sim {

using Json = nlohmann::json;

class ExperimentReport : public ReportCase {
 protected:
  /// What a run counted.
  Json run(const std::string& name, const std::string& scenario) const {
    write(name + ".toml", scenario);
    const Outcome o = program({"run", name + ".toml", "-q", "--json", "-o", name + ".h5"});
    EXPECT_EQ(o.code, 0) << o.err;
    return Json::parse(o.out);
  }
  static std::int64_t sum(const Json& run, const std::string& variable) {
    std::int64_t sum = 0;
    for (const Json& value : run["variables"][variable]["values"]) sum += value.get<std::int64_t>();
    return sum;
  }
};

inline void expect_has(const std::string& page, const std::string& text) {
  EXPECT_NE(page.find(text), std::string::npos) << text;
}

/// Of device `device` of two at point `point`.
inline std::int64_t cell(const Json& run, const std::string& variable, std::size_t point,
                         std::size_t device) {
  return run["variables"][variable]["values"][2 * point + device].get<std::int64_t>();
}

/// Two devices: one is near, and silent at times, the other out of reach.
inline const std::string arena = R"(title = "<b>"
experiment = "arena"
[receiver]
module = "TSSP4056"
[simulation]
sample_rate_hz = 250000
[path]
x_m = [0, 1]
speed_m_per_s = 0.25
[arena]
runs = 2
[devices.near]
x_m = 1.5
y_m = 0
yaw_deg = 180
silent_every_s = 1
silent_for_s = 1
[devices.away]
x_m = 50
y_m = 0
)";

}  // namespace sim
