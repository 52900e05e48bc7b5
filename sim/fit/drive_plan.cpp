#include "sim/fit/drive_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/failure.hpp"
#include "sim/text/escaped_text.hpp"

namespace sim {
namespace {

constexpr double longest_gap_cycles = 3;  // within a burst

/// A burst of pulses as it is read: edges of the same direction as its first are the cycles'.
class PulsesOfBurst {
 public:
  explicit PulsesOfBurst(double first_s) : first_s_(first_s), last_s_(first_s) {}

  void take(double edge_s) {
    ++edges_;
    if (edges_ % 2 == 1) last_s_ = edge_s;
  }

  /// One pulse alone has no carrier of its own.
  DriveBurst burst(double usual_carrier_hz) const {
    const std::uint64_t cycles = (edges_ + 1) / 2;
    if (cycles < 2) return {first_s_, usual_carrier_hz, cycles};
    return {first_s_, static_cast<double>(cycles - 1) / (last_s_ - first_s_), cycles};
  }

 private:
  double first_s_, last_s_;
  std::uint64_t edges_ = 1;
};

/// Of a wire that carries a carrier: pulse by pulse.
std::vector<DriveBurst> bursts_of_pulses(const Capture& capture, double carrier_hz,
                                         const ReadingListener& reached) {
  WireEdges wire(*capture.logic, capture.wire);
  const double gap_s = longest_gap_cycles / carrier_hz;
  std::vector<DriveBurst> bursts;
  std::optional<PulsesOfBurst> pulses;
  std::optional<double> last_s;
  while (const auto edge = wire.next()) {
    if (pulses && edge->value - *last_s <= gap_s) {
      pulses->take(edge->value);
    } else {
      if (pulses) bursts.push_back(pulses->burst(carrier_hz));
      pulses.emplace(edge->value);
      reached(*edge);
    }
    last_s = edge->value;
  }
  if (pulses) bursts.push_back(pulses->burst(carrier_hz));
  return bursts;
}

/// Of a level: light is the one that it does not idle at, or low of what was demodulated.
std::vector<DriveBurst> bursts_of_level(const CapturedLine& line, double carrier_hz) {
  const bool light = line.carrier_hz == 0 && !line.idles_high();
  std::vector<DriveBurst> bursts;
  bool level = line.initial;
  double start_s = 0;
  const auto end_spell = [&](double end_s) {
    const double cycles = std::round((end_s - start_s) * carrier_hz);
    if (level == light && cycles >= 1)
      bursts.push_back({start_s, carrier_hz, static_cast<std::uint64_t>(cycles)});
    level = !level;
    start_s = end_s;
  };
  for (const double edge_s : line.edges_s) end_spell(edge_s);
  end_spell(line.end_s);
  return bursts;
}

PlanStep step_of_burst(const DriveBurst& burst) {
  return {.start_ms = 1e3 * burst.start_s,
          .carrier_hz = burst.carrier_hz,
          .cycles_on = burst.cycles,
          .level_db = 0};
}

double cycle_ms(const PlanStep& step) { return 1e3 / step.carrier_hz; }

/// The cycles between a step's last burst and another burst; less than 0 where it is no such gap.
double gap_cycles(const PlanStep& step, const DriveBurst& next) {
  constexpr double longest = 1e9;
  const double dark_ms = 1e3 * next.start_s - end_ms(step);
  const double cycles = std::round(dark_ms / cycle_ms(step));
  return cycles > longest ? -1 : cycles;
}

bool is_alike(const PlanStep& step, const DriveBurst& burst) {
  constexpr double same_carrier = 1e-3;
  return step.cycles_on == burst.cycles &&
         std::abs(burst.carrier_hz / step.carrier_hz - 1) < same_carrier;
}

/// Makes the burst one more of a step, if it comes when the step's next one would.
bool joins(PlanStep& step, const DriveBurst& burst) {
  if (!is_alike(step, burst)) return false;
  if (step.repeats == 1) {
    const double gap = gap_cycles(step, burst);
    if (gap < 1) return false;
    step.cycles_off = static_cast<std::uint64_t>(gap);
  } else if (std::abs(1e3 * burst.start_s - end_ms(step)) > cycle_ms(step)) {
    return false;
  }
  ++step.repeats;
  return true;
}

/// A step ends with the gap of its bursts: where the next one comes sooner the last burst is taken
/// out, as a step of its own.
void part_from_next(std::vector<PlanStep>& steps, const DriveBurst& next) {
  PlanStep& step = steps.back();
  if (step.repeats == 1 || end_ms(step) <= 1e3 * next.start_s) return;
  PlanStep last = step;
  --step.repeats;
  last.start_ms = end_ms(step);
  last.repeats = 1;
  last.cycles_off = 0;
  if (step.repeats == 1) step.cycles_off = 0;
  steps.push_back(last);
}

}  // namespace

Plan plan_of_bursts(const std::vector<DriveBurst>& bursts) {
  Plan plan;
  for (const DriveBurst& burst : bursts) {
    if (!plan.steps.empty()) {
      if (joins(plan.steps.back(), burst)) continue;
      part_from_next(plan.steps, burst);
      if (joins(plan.steps.back(), burst)) continue;
    }
    plan.steps.push_back(step_of_burst(burst));
  }
  return plan;
}

Plan plan_of_drive(const std::filesystem::path& path, const CaptureSettings& settings,
                   double carrier_hz, const ReadingListener& reached) {
  const CapturedLine line = read_lines(path, settings, reached).front();
  const bool has_pulses = line.carrier_hz > 0 && !line.is_sampled;
  const std::vector<DriveBurst> bursts =
      has_pulses ? bursts_of_pulses(open_capture(path, settings), line.carrier_hz, reached)
                 : bursts_of_level(line, line.carrier_hz > 0 ? line.carrier_hz : carrier_hz);
  if (bursts.empty())
    throw bad_input(fmt::format("{} of {}", escaped_name(settings.wire), path.string()),
                    "it never changes: no light is on it", "say --drive, or --plan PLAN");
  return plan_of_bursts(bursts);
}

}  // namespace sim
