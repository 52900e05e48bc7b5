#include "sim/engine/search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/counting/stop_rule.hpp"
#include "sim/scenario/sweep.hpp"
#include "sim/text/number_text.hpp"

namespace sim {
namespace {

/// As written with few digits, enough of them for the tolerance; users read and type these values.
double rounded(double value, double tolerance) {
  const int digits = 2 + std::max(0, static_cast<int>(std::ceil(-std::log10(tolerance))));
  return parse_number(fmt::format("{:.{}g}", value, digits)).value_or(value);
}

/// A value about in the middle of two, on a logarithmic axis where that exists; nothing once they
/// are near enough to each other.
std::optional<double> between(double a, double b, const SearchRange& range) {
  const auto [low, high] = std::minmax(a, b);
  const double scale = std::max(std::abs(range.low), std::abs(range.high));
  if (high - low <= range.tolerance * (low > 0 ? high : scale)) return std::nullopt;
  const double exact = low > 0 ? std::sqrt(low) * std::sqrt(high) : low + (high - low) / 2;
  double middle = range.whole_numbers ? std::round(exact) : rounded(exact, range.tolerance);
  if (middle <= low || middle >= high) middle = exact;
  if (range.whole_numbers && middle != std::round(middle)) return std::nullopt;
  return middle;
}

/// The bracket at work.
class Search {
 public:
  Search(const SearchRange& range, double flr, const CountAt& count)
      : range_(range), flr_(flr), count_(count), near_(range.low), far_(range.high) {}

  void run() {
    look_at(near_, near_side_);
    look_at(far_, far_side_);
    if (near_side_ == far_side_) return;
    while (const auto middle = inside(near_, far_))
      if (!narrow_to(*middle)) return look_beside(*middle);
  }

 private:
  /// Nothing once the bracket is narrow, or the search interrupted.
  std::optional<double> inside(double a, double b) const {
    return interrupted_ ? std::nullopt : between(a, b, range_);
  }

  void look_at(double value, Side& side) {
    if (interrupted_) return;
    const std::optional<Tally> counted = count_(value);
    interrupted_ = !counted;
    if (counted) side = side_of(*counted, flr_);
  }

  /// False if the middle is about at the level and the ends are on their sides of it.
  bool narrow_to(double middle) {
    Side side = Side::unknown;
    look_at(middle, side);
    if (side == far_side_) {
      far_ = middle;
    } else if (side == near_side_ || near_side_ == Side::unknown) {
      near_ = middle;
      near_side_ = side;
    } else if (far_side_ == Side::unknown) {
      far_ = middle;
      far_side_ = side;
    } else {
      return false;
    }
    return true;
  }

  /// Neighbours of a point at the level give a fit the slope. Those that are far from the level
  /// give none, so the one next to the point is looked for that does, or is as near as may be.
  void look_beside(double middle) {
    for (double end : {near_, far_}) {
      Side side = Side::unknown;
      do {
        const auto beside = inside(end, middle);
        if (!beside) break;
        look_at(end = *beside, side);
      } while (side != Side::unknown);
    }
  }

  const SearchRange& range_;
  const double flr_;
  const CountAt& count_;
  double near_, far_;
  Side near_side_ = Side::unknown, far_side_ = Side::unknown;
  bool interrupted_ = false;
};

}  // namespace

void search(const SearchRange& range, double flr, const CountAt& count) {
  Search(range, flr, count).run();
}

}  // namespace sim
