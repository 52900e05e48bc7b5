#include "sim/arena/arena_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/arena/arena_columns.hpp"
#include "sim/arena/sender.hpp"
#include "sim/arena/trajectory.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/picture/floor_plan.hpp"
#include "sim/result/place_text.hpp"
#include "sim/scenario/sweep.hpp"
#include "sim/section/dataset_cells.hpp"
#include "sim/section/dataset_table.hpp"

namespace sim {
namespace {

/// A variable of each device at one point; those of devices that the file does not know are NaN.
class DeviceCells {
 public:
  DeviceCells(const Dataset& data, const std::string& name, std::size_t point)
      : data_(data), cells_(data, name), point_(point) {}

  std::string text(const std::string& device) const {
    const auto cell = place_of(device);
    return cell ? cells_.text(*cell) : "-";
  }
  double operator[](const std::string& device) const {
    const auto cell = place_of(device);
    return cell ? cells_[*cell] : std::nan("");
  }

 private:
  std::optional<std::size_t> place_of(const std::string& device) const {
    if (cells_.empty()) return std::nullopt;
    const Dataset::Dimension& names = dimension_named(data_, "device");
    std::size_t place = 0;
    while (place < names.size() && value_text(names, place) != device) ++place;
    if (place == names.size()) return std::nullopt;
    return point_ * names.size() + place;
  }

  const Dataset& data_;
  DatasetCells cells_;
  std::size_t point_;
};

/// Kinds of devices in the order of the devices, each with its colour.
std::vector<std::string> kinds_on_map(const std::vector<Sender>& senders) {
  std::vector<std::string> kinds;
  for (const Sender& sender : senders)
    if (std::ranges::find(kinds, sender.kind) == kinds.end()) kinds.push_back(sender.kind);
  return kinds;
}

std::size_t colour_of(const std::vector<std::string>& kinds, const std::string& kind) {
  return static_cast<std::size_t>(std::ranges::find(kinds, kind) - kinds.begin());
}

/// The name of a device, or at the first of a kind that has several that of the kind; else nothing.
std::string label_on_map(const Sender& sender, const std::vector<Sender>& senders) {
  const auto n = std::ranges::count(senders, sender.kind, &Sender::kind);
  if (n == 1) return sender.name;
  return sender.number == 1 ? fmt::format("{} x{}", sender.kind, n) : "";
}

std::vector<PlanMark> marks_of(const std::vector<Sender>& senders, const DeviceCells& delivered) {
  const std::vector<std::string> kinds = kinds_on_map(senders);
  std::vector<PlanMark> marks;
  for (const Sender& s : senders)
    marks.push_back({.at = {s.x_m, s.y_m},
                     .label = label_on_map(s, senders),
                     .heading = s.leds == 1 ? std::optional(s.yaw.value) : std::nullopt,
                     .colour = colour_of(kinds, s.kind),
                     .is_solid = delivered[s.name] > 0});
  return marks;
}

/// Which device each message that was heard is of, where, and when: those of one point.
struct HeardMessage {
  std::string device;
  PlanPoint at;
  dsp::Seconds end;
};

std::vector<HeardMessage> heard_on_map(const Dataset& data, std::size_t point) {
  const DatasetCells points(data, "heard_point"), devices(data, "heard_device"),
      x(data, "heard_x_m"), y(data, "heard_y_m"), ends(data, "heard_end_s");
  std::vector<HeardMessage> heard;
  if (points.empty()) return heard;
  const Dataset::Dimension& names = dimension_named(data, "device");
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i] == static_cast<double>(point) && devices[i] >= 0 &&
        devices[i] < static_cast<double>(names.size()))
      heard.push_back({value_text(names, static_cast<std::size_t>(devices[i])),
                       {x[i], y[i]},
                       dsp::Seconds(ends[i])});
  return heard;
}

std::vector<PlanDots> dots_of(const std::vector<HeardMessage>& heard,
                              const std::vector<Sender>& senders, const Trajectory& way) {
  std::map<std::string, std::string> kind_of;
  for (const Sender& sender : senders) kind_of[sender.name] = sender.kind;
  std::vector<PlanDots> dots;
  for (const std::string& kind : kinds_on_map(senders)) dots.push_back({kind, {}, dots.size()});
  for (const HeardMessage& each : heard)
    for (PlanDots& kind : dots)
      if (kind.label == kind_of[each.device])
        kind.dots.push_back({each.at, way.at(each.end).heading.value});
  for (PlanDots& kind : dots) kind.label += fmt::format(": {} messages heard", kind.dots.size());
  return dots;
}

PageTable table_of(const std::vector<Sender>& senders, const Dataset& data, std::size_t point) {
  PageTable table{.head = {"device", "x [m]", "y [m]"}, .rows = {}};
  std::vector<DeviceCells> columns;
  for (const DatasetColumn& column :
       headed_columns(data, arena_columns().facts(),
                      {"irradiance_mw_per_m2", "n_messages_sent", "n_delivered", "frame_loss"})) {
    table.head.push_back(column.head);
    columns.emplace_back(data, column.name, point);
  }
  for (const Sender& s : senders) {
    table.rows.push_back({s.name, fmt::format("{:.3g}", s.x_m), fmt::format("{:.3g}", s.y_m)});
    for (const DeviceCells& column : columns) table.rows.back().push_back(column.text(s.name));
  }
  return table;
}

FloorPlan plan_of(const StoredDataset& stored, std::size_t point,
                  const std::vector<Sender>& senders, const Trajectory& way) {
  FloorPlan plan{.title = "Where messages were heard",
                 .description =
                     "Devices (discs; rings where nothing was heard of them), the receiver's way, "
                     "and a dot where it was at the end of each message that it heard, beside the "
                     "way in the colour of the device"};
  for (const Pose2D& corner : way.corners()) plan.way.push_back({corner.x, corner.y});
  const Pose2D begin = way.at(dsp::Seconds(0));
  plan.receivers.push_back({.at = {begin.x, begin.y}, .heading = begin.heading.value});
  plan.devices = marks_of(senders, DeviceCells(stored.data, "n_delivered", point));
  plan.dots = dots_of(heard_on_map(stored.data, point), senders, way);
  return plan;
}

}  // namespace

PageSection arena_map(const StoredDataset& stored, std::size_t point) {
  const Scenario scenario =
      point_scenario(stored.scenario, point_coordinates(stored.data.axes, point));
  const std::vector<Sender> senders = make_senders(scenario);
  const FloorPlan plan = plan_of(stored, point, senders, Trajectory(scenario.path));
  const std::string place = place_text(stored.data, point);
  return {.heading = plan.title + (place.empty() ? "" : ", " + place),
          .text = "The floor is \"" + scenario.floor_settings.part + "\".",
          .picture = PagePicture{"map", plan.description, floor_plan_as_svg(plan)},
          .table = table_of(senders, stored.data, point)};
}

}  // namespace sim
