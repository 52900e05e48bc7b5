#include "sim/result/crossing_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/result/place_text.hpp"
#include "sim/text/rounded_text.hpp"
#include "sim/text/unit_text.hpp"

namespace sim {
namespace {

using Kind = Crossing::Kind;

/// Whether so many frames do not tell its side of the level.
bool is_doubtful(const Crossing& c, double level) {
  if (c.kind == Kind::all_above) return c.bound < level;
  return (c.kind == Kind::all_below || c.kind == Kind::jump) && c.bound > level;
}

/// ", though 3.8 % cannot be ruled out": what the frames do not tell; of a jump with its place.
std::string doubt(const Axis& axis, const Crossing& c, double level) {
  if (!is_doubtful(c, level)) return "";
  const std::string at = with_unit(fmt::format("{:g}", c.bound_at), axis.unit);
  return fmt::format(", though {:.2g} % cannot be ruled out{}", c.bound * 100,
                     c.kind == Kind::jump ? " at " + at : "");
}

std::string span_text(const Crossing& c) {
  return c.low == c.high ? fmt::format("{:g}", c.low) : fmt::format("{:g} .. {:g}", c.low, c.high);
}

/// Of a fitted crossing: so many that two digits of its margin are seen.
int places_of(const Crossing& c) {
  const double margin = std::max((c.high - c.low) / 2, 1e-12);
  return std::max(0, 1 - static_cast<int>(std::floor(std::log10(margin))));
}

/// The ends rounded outwards.
std::string fitted_text(const Crossing& c) {
  const int places = places_of(c);
  return fmt::format("{} [{}, {}]", fixed_text(c.at, places),
                     fixed_text(c.low, places, Rounding::down),
                     fixed_text(c.high, places, Rounding::up));
}

/// The side on which a bracket has no end, "" if it has both.
std::string open_side(const Crossing& c) {
  if (std::isinf(c.low)) return "below";
  return std::isinf(c.high) ? "above" : "";
}

std::string only_end(const Crossing& c) {
  return fmt::format("{:g}", std::isinf(c.low) ? c.high : c.low);
}

std::string not_told(const Axis& axis, const Crossing& c) {
  if (std::isnan(c.low)) return "not counted yet";
  return "not told yet: counted at " + with_unit(span_text(c), axis.unit) + " alone";
}

std::string too_few(const Crossing& c) {
  return fmt::format(": too few frames to tell how far {}", open_side(c));
}

/// What lies on one side of an end.
std::string open_words(const Axis& axis, double end, bool is_more) {
  return (is_more ? "more than " : "less than ") + with_unit(fmt::format("{:g}", end), axis.unit);
}

std::string value_words(const Axis& axis, double value) {
  return with_unit(coordinate_text(axis, value), axis.unit);
}

}  // namespace

std::string crossing_words(const Axis& axis, const Crossing& c, bool more_is_better) {
  if (c.kind == Kind::fitted) return with_unit(fitted_text(c), axis.unit);
  if (c.kind == Kind::unfinished) return not_told(axis, c);
  return short_crossing_words(axis, c, more_is_better);
}

std::string crossing_note(const Crossing& c, double level) {
  if (c.kind == Kind::bracketed) return open_side(c).empty() ? "" : "too few frames";
  return is_doubtful(c, level) ? fmt::format("{:.2g} % possible", c.bound * 100) : "";
}

std::string short_crossing_words(const Axis& axis, const Crossing& c, bool more_is_better) {
  switch (c.kind) {
    case Kind::all_below:
      return open_words(axis, more_is_better ? c.low : c.high, !more_is_better);
    case Kind::all_above:
      return open_words(axis, more_is_better ? c.high : c.low, more_is_better);
    case Kind::fitted:
      return with_unit(fixed_text(c.at, places_of(c)), axis.unit);
    case Kind::jump:
    case Kind::bracketed:
      if (std::isinf(c.low)) return open_words(axis, c.high, false);
      if (std::isinf(c.high)) return open_words(axis, c.low, true);
      return with_unit(fmt::format("{:g} to {:g}", c.low, c.high), axis.unit);
    case Kind::not_monotone:
      return "no single value, as loss rises and falls";
    case Kind::unfinished:
    case Kind::unclear:
      break;
  }
  return "not told by so few frames";
}

std::string crossing_sentence(const Axis& axis, const Crossing& c, double level) {
  const std::string crosses = fmt::format("frame loss crosses {:g} % ", level * 100);
  const std::string range = quantity(axis, span_text(c));
  switch (c.kind) {
    case Kind::fitted:
      return crosses + "at " + quantity(axis, fitted_text(c));
    case Kind::jump:
      return crosses + "between " + range + ", two neighbours in the sweep" + doubt(axis, c, level);
    case Kind::bracketed:
      if (!open_side(c).empty())
        return crosses + open_side(c) + " " + quantity(axis, only_end(c)) + too_few(c);
      return crosses + "between " + range;
    case Kind::not_monotone:
      return fmt::format("frame loss rises and falls along {}: no single crossing of {:g} %",
                         axis.key, level * 100);
    case Kind::all_below:
      return fmt::format("frame loss {} at most {:g} % over ",
                         doubt(axis, c, level).empty() ? "stays" : "is seen to stay", level * 100) +
             range + doubt(axis, c, level);
    case Kind::all_above:
      return fmt::format("frame loss is above {:g} % over ", level * 100) + range +
             doubt(axis, c, level);
    case Kind::unfinished:
      return fmt::format("where frame loss crosses {:g} % along {} is {}", level * 100, axis.key,
                         not_told(axis, c));
    case Kind::unclear:
      break;
  }
  return fmt::format("frame loss does not clearly cross {:g} % inside the sweep of {}", level * 100,
                     axis.key);
}

std::string reach_sentence(const Axis& axis, const Crossing& c, double level) {
  const double percent = level * 100;
  const std::string range = with_unit(span_text(c), axis.unit);
  const std::string reaches = "the link reaches " + crossing_words(axis, c, false);
  const std::string at = fmt::format("{} at {:g} % frame loss", reaches, percent);
  switch (c.kind) {
    case Kind::jump:
      return at + ", two neighbours in the sweep" + doubt(axis, c, level);
    case Kind::fitted:
    case Kind::bracketed:
      return open_side(c).empty() ? at : at + too_few(c);
    case Kind::all_below:
      return fmt::format("{}: at most {:g} % of frames lost at {}", reaches, percent, range) +
             doubt(axis, c, level);
    case Kind::all_above:
      return fmt::format("{}: more than {:g} % of frames lost at {}", reaches, percent, range) +
             doubt(axis, c, level);
    case Kind::not_monotone:
    case Kind::unfinished:
    case Kind::unclear:
      break;
  }
  return crossing_sentence(axis, c, level);
}

std::string range_words(const Axis& axis, const UnitRange& range) {
  if (std::isinf(range.low)) return "below " + value_words(axis, range.high);
  if (std::isinf(range.high)) return "beyond " + value_words(axis, range.low);
  return coordinate_text(axis, range.low) + " to " + value_words(axis, range.high);
}

std::string span_words(const Axis& axis, const RangeQuantiles& quantiles) {
  const UnitRange span = span_of(quantiles);
  const auto [least, most] = std::ranges::minmax(axis.values);
  const bool has_ends = std::isfinite(span.low) && std::isfinite(span.high);
  if (has_ends || span.high <= least || span.low >= most) return range_words(axis, span);
  const std::string low =
      std::isinf(span.low) ? "below " + value_words(axis, least) : value_words(axis, span.low);
  const std::string high =
      std::isinf(span.high) ? "beyond " + value_words(axis, most) : value_words(axis, span.high);
  return low + " to " + high;
}

}  // namespace sim
