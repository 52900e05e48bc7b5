#include "sim/scenario/placed_device_keys.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "sim/scenario/key_making.hpp"
#include "sim/scenario/message_source.hpp"
#include "sim/scenario/named_key.hpp"

namespace sim {
namespace {

const std::string table_of_devices = "devices";

/// Keys of one device, whose name is a part of them.
class DeviceKeys {
 public:
  explicit DeviceKeys(std::string name) : name_(std::move(name)) {}

  void number(const std::string& what, const std::string& unit, Range range,
              double PlacedDevice::*member, const std::string& long_name,
              const std::string& note = "", KeyType type = KeyType::number) {
    keys_.push_back(
        {{full(what), unit, range, long_name, note, type},
         [name = name_, member](Scenario& s) -> double& { return s.devices[name].*member; },
         {},
         {}});
  }

  void whole(const std::string& what, Range range, double PlacedDevice::*member,
             const std::string& long_name, const std::string& note = "") {
    number(what, "1", range, member, long_name, note, KeyType::whole_number);
  }

  Key& text(KeyType type, const std::string& what, std::string PlacedDevice::*member,
            const std::string& long_name, const std::string& note = "") {
    keys_.push_back(
        {{full(what), "", {}, long_name, note, type},
         {},
         [name = name_, member](Scenario& s) -> std::string& { return s.devices[name].*member; },
         {}});
    keys_.back().swept = false;
    return keys_.back();
  }

  std::vector<Key> take() { return std::move(keys_); }

 private:
  std::string full(const std::string& what) const {
    return table_of_devices + "." + name_ + "." + what;
  }

  std::string name_;
  std::vector<Key> keys_;
};

void add_place(DeviceKeys& keys) {
  keys.number("x_m", "m", from(-1000, 1000), &PlacedDevice::x_m, "place of the device along x");
  keys.number("y_m", "m", from(-1000, 1000), &PlacedDevice::y_m, "place of the device along y");
  keys.whole("count", from(1, 1000), &PlacedDevice::count, "devices of this kind",
             "more than one are NAME-1, NAME-2 ...");
  keys.number("spread_x_m", "m", from(0, 1000), &PlacedDevice::spread_x_m,
              "width of the rectangle that they stand in",
              "uniform around x_m, the same in all runs");
  keys.number("spread_y_m", "m", from(0, 1000), &PlacedDevice::spread_y_m,
              "depth of the rectangle that they stand in");
  keys.number("height_mm", "mm", from(0.1, 1e4), &PlacedDevice::height_mm, "height of its LED",
              "unset: `led.height_mm`");
  keys.number("yaw_deg", "degree", from(-180, 180), &PlacedDevice::yaw_deg, "direction of its LED",
              "0: along x, 90: along y");
  keys.number("yaw_spread_deg", "degree", from(0, 360), &PlacedDevice::yaw_spread_deg,
              "width of the range of directions", "uniform around yaw_deg; 360: any");
}

void add_light(DeviceKeys& keys) {
  keys.text(KeyType::text, "led", &PlacedDevice::led, "LED of the device",
            "a file in `leds/`; empty: `led.part`");
  keys.whole("leds", from(1, 36), &PlacedDevice::leds, "LEDs in even steps around the device",
             "the first looks along yaw_deg");
  keys.number("current_ma", "mA", from(0.01, 1500), &PlacedDevice::current_ma,
              "current of each while lit", "unset: `led.current_ma`");
  keys.number("carrier_error_ppm", "1e-6", from(-2e5, 2e5), &PlacedDevice::carrier_error_ppm,
              "error of its carrier frequency");
  keys.number("carrier_spread_ppm", "1e-6", from(0, 2e5), &PlacedDevice::carrier_spread_ppm,
              "width of the range of that error among devices of the kind");
  keys.number("clock_error_ppm", "1e-6", from(-1e5, 1e5), &PlacedDevice::clock_error_ppm,
              "clock error of its UART");
  keys.number("clock_spread_ppm", "1e-6", from(0, 1e5), &PlacedDevice::clock_spread_ppm,
              "width of the range of that error among devices of the kind");
}

void add_messages(DeviceKeys& keys) {
  Key& source =
      keys.text(KeyType::choice, "source", &PlacedDevice::source, "choice of the message sent",
                "the first; one after the other; the first with a count of six digits "
                "behind it; one of them until the status changes");
  source.choices = names_of(message_sources());
  keys.text(KeyType::messages, "messages", &PlacedDevice::messages, "device messages",
            "one or a list; `{}` in one is the number of the device in its kind");
  keys.number("status_hold_s", "s", from(0.01, 1e6), &PlacedDevice::status_hold_s,
              "mean time that a status lasts", "exponential");
}

void add_times(DeviceKeys& keys) {
  keys.number("interval_min_ms", "ms", from(0, 1e6), &PlacedDevice::interval_min_ms,
              "shortest pause between its messages", "end of one to start of the next");
  keys.number("interval_max_ms", "ms", from(0, 1e6), &PlacedDevice::interval_max_ms,
              "longest pause between its messages",
              "pauses are uniform between the two; fixed where they are equal");
  Key& list = keys.text(KeyType::number_list, "intervals_ms", &PlacedDevice::intervals_ms,
                        "pauses in turn, instead of those", "from a random one on");
  list.facts.unit = "ms";
  list.facts.range = from(0, 1e6);
  keys.text(KeyType::text, "interval_file", &PlacedDevice::interval_file, "file of such pauses",
            "one a line, beside the scenario");
  keys.number("silent_every_s", "s", from(0, 1e6), &PlacedDevice::silent_every_s,
              "mean time from the end of a silent spell to the next",
              "exponential; 0: never silent");
  keys.number("silent_for_s", "s", from(0.001, 1e6), &PlacedDevice::silent_for_s,
              "mean length of a silent spell", "exponential");
}

}  // namespace

std::vector<Key> path_keys() {
  constexpr auto at = &Scenario::path;
  using P = PathSettings;
  return all_younger({
      number_list("path.x_m", "m", from(-1000, 1000), at, &P::x_m, "way-points along x",
                  "one: the receiver stands there"),
      number_list("path.y_m", "m", from(-1000, 1000), at, &P::y_m, "way-points along y"),
      number_list("path.heading_deg", "degree", from(-360, 360), at, &P::heading_deg,
                  "heading at each way-point", "unset: where it goes; `receiver.yaw_deg` adds"),
      number("path.speed_m_per_s", "m/s", from(0.001, 100), at, &P::speed_m_per_s,
             "speed along the way"),
      number("path.turn_deg_per_s", "degree/s", from(0.1, 3600), at, &P::turn_deg_per_s,
             "speed of turning at way-points", "where no headings are given"),
  });
}

const std::vector<Key>& placed_device_keys(const std::string& name) {
  static std::map<std::string, std::vector<Key>> known;
  const auto old = known.find(name);
  if (old != known.end()) return old->second;
  DeviceKeys keys(name);
  add_place(keys);
  add_light(keys);
  add_messages(keys);
  add_times(keys);
  return known.emplace(name, keys.take()).first->second;
}

const Key* find_placed_device_key(const std::string& name) {
  const auto of = named_key(table_of_devices, name);
  if (!of || !is_table_name(of->name)) return nullptr;
  const std::vector<Key>& keys = placed_device_keys(of->name);
  const auto at = std::ranges::find(keys, name, &Key::name);
  return at == keys.end() ? nullptr : &*at;
}

}  // namespace sim
