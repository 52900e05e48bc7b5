#include "sim/result/alarms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "sim/counting/statistics.hpp"
#include "sim/link/theory.hpp"

namespace sim {
namespace {

/// A sweep has many points, none of which should raise an alarm by chance.
constexpr double surely = 0.99999;

Estimate sure_ber(const LinkPoint& p) { return bit_error_ratio(p.tally, surely); }

bool above_half(const LinkPoint& p) { return sure_ber(p).low > 0.5; }

bool contradicts_theory(const LinkPoint& p) {
  const double sampled = p.operating.ber_sampled;  // NaN of decisions, which are all alike
  const double theory = std::isnan(sampled) ? p.operating.ber_theory : sampled;  // NaN: none
  return theory < sure_ber(p).low || theory > sure_ber(p).high;
}

/// 3 dB beyond a coherent matched receiver at the middle threshold: room for a message's share of
/// light and for units that are better than typical. A pin that stands still has the share of the
/// other bits, 0.2 at least of any printable message.
bool beats_theory(const LinkPoint& p) {
  const double ebn0 = std::pow(10, p.operating.ebn0_db / 10);
  return sure_ber(p).high < std::min(coherent_ook_ber(2 * ebn0), 0.1);
}

/// Nothing that was drawn makes a dark bit light: where noise does so this much more rarely than
/// frames are lost, that does not show.
constexpr double harmless_share = 0.01;

bool leaves_dark_bits_out(const LinkPoint& p) {
  const Weighted& weighted = p.tally.weighted;
  return p.tally.is_weighted() &&
         weighted.dark_likelihood > harmless_share * weighted.frames_lost.sum;
}

bool has_uneven_weights(const LinkPoint& p) {
  const Weighted& weighted = p.tally.weighted;
  return p.tally.is_weighted() &&
         !(weighted.bit_errors.is_sound() && weighted.frames_lost.is_sound());
}

constexpr std::array alarm_table{
    Alarm{"half", "bit error ratio above 0.5: silence reads as ones, so the link is dead",
          above_half},
    Alarm{"theory", "bit error ratio other than theory's for this receiver", contradicts_theory},
    Alarm{"impossible", "fewer bit errors than any receiver could make at this Eb/N0",
          beats_theory},
    Alarm{"monotone", "frame loss rises and falls along the sweep by more than its intervals",
          nullptr},
    Alarm{"weights",
          "importance sampling drew too few failures, or a few of them weigh too much: a ratio has "
          "no "
          "estimate",
          has_uneven_weights},
    Alarm{"dark", "noise may make dark bits light, which importance sampling did not draw",
          leaves_dark_bits_out},
};
constexpr std::uint64_t monotone = 1 << 3;

}  // namespace

std::span<const Alarm> alarms() { return alarm_table; }

std::uint64_t own_alarms(const LinkPoint& point) {
  std::uint64_t mask = 0;
  for (std::size_t i = 0; i < alarm_table.size(); ++i)
    if (alarm_table[i].raised != nullptr && alarm_table[i].raised(point))
      mask |= std::uint64_t{1} << i;
  return mask;
}

void add_row_alarms(LinkResult& result, const CrossingQuestion& question) {
  const Ranking ranking = rank(result, question);
  if (ranking.abscissa == Ranking::none) return;
  std::set<std::vector<double>> alarming;
  for (const RowCrossing& row : ranking.rows)
    if (row.crossing.kind == Crossing::Kind::not_monotone) alarming.insert(row.others);
  for (LinkPoint& point : result.points) {
    std::vector<double> others;
    for (const std::size_t axis : ranking.others) others.push_back(point.coordinates[axis]);
    if (point.reached() && alarming.contains(others)) point.alarms |= monotone;
  }
}

}  // namespace sim
